//! Clouds from density contour lines (K. Miyata, *A generation method of cloud images using density contour lines*).
//!
//! Contours of equal density are taken as those of a mountain; its surface, made rough by recursive subdivision, is the
//! upper face of a layer of droplets.
//!
//! | to | open |
//! |---|---|
//! | see where the page is disputed | [`Amplitude`], [`EdgeLength`] |
//! | find the feature points of a contour, §2.1 | [`feature_points`] |
//! | measure its fractal dimension, §2.1 | [`divider`] |
//! | put triangles between contours, §2.1 | [`Contour`], [`traced`], [`Patches`] |
//! | divide and displace triangles, §2.2, Eq. (1) | [`Surface`], [`Displacement`], [`Tile`] |
//! | have no crease where patches meet | [`Relief`], [`Smooth`] |
//! | have its heights on a grid | [`Grid`] |
//! | show the surface as droplets, §3, Eq. (2) to (10) | [`Layer`], [`Cut`], [`Passage`], [`Compositing`] |
//! | see it from above, or overhead | [`Window`], [`Overhead`], [`Raster`] |
//! | see it as a mountain | [`Camera`], [`Scene`] |
//! | measure the dimension of what came out | [`spectral_dimension`] |

mod camera;
mod dimension;
mod displacement;
mod feature;
mod grid;
mod layer;
mod light;
mod mesh;
mod patches;
mod plateau;
mod raster;
mod readings;
mod relief;
mod roughness;
mod surface;
mod tile;
mod trace;
mod view;

pub use camera::{Camera, Scene, lambert, normal};
pub use dimension::{POOLED_BELOW, dimensions, divider, walk};
pub use displacement::Displacement;
pub use feature::feature_points;
pub use grid::{Grid, Outside};
pub use layer::Layer;
pub use light::{Compositing, Cut, Passage, W, lost, pixel, transmitted};
pub use patches::{Contour, ContourError, Patches};
pub use raster::Raster;
pub use readings::{Amplitude, EdgeLength, Plateau, SurfaceDimension};
pub use relief::{Relief, Smooth};
pub use roughness::spectral_dimension;
pub use surface::{Corner, Edge, Levels, Limit, Piece, Surface, centroid};
pub use tile::Tile;
pub use trace::{Traced, traced};
pub use view::{Fineness, Overhead, Window};
