//! Light on ice on glass: what a camera straight in front of the pane sees of one place of it.
//!
//! One layer of ice, seen along its normal but for the slope of its surface. With h its thickness, v the direction to
//! the camera and n the normal of the surface:
//!
//! L = (1 - F) [τ B + (1 - τ) M] + F E,  τ = exp(-k h)
//!
//! | symbol | meaning |
//! |---|---|
//! | F | Fresnel's reflectance of a dielectric of index 1.31 at the angle between v and n, unpolarised |
//! | B | the scene behind, displaced by the refracted ray and blurred by the ice's roughness |
//! | M | light that bubbles and grain boundaries scatter back: sky, room and what shines through |
//! | E | what is mirrored: the sky by the window and two lamps, each a lobe |
//! | k | extinction of milky ice, per mm |

use super::night::Light;

/// The refractive index of ice.
pub const INDEX: f32 = 1.31;
/// Extinction of milky ice, per mm.
pub const EXTINCTION: f32 = 1.35;

/// A direction or a colour.
type Triple = [f32; 3];

fn dot(a: Triple, b: Triple) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Directions: x to the right, y down, z to the camera. All are of length 1.
const KEY: Triple = [-0.662_9, -0.714_1, 0.224_6];
const LAMP: Triple = [0.6, 0.3, 0.741_6];

/// Light that falls on the ice from each side.
const KEY_LIGHT: Triple = [1.66, 1.88, 2.12];
const SKY: Triple = [0.030, 0.096, 0.255];
const LAMP_LIGHT: Triple = [0.150, 0.078, 0.030];

/// What is mirrored: a direction near that of the camera, since slopes are small, how narrow, and how bright.
struct Mirrored(Triple, f32, Triple);

static MIRRORED: [Mirrored; 3] = [
    // The sky above the camera, broad.
    Mirrored([-0.363_8, -0.485_1, 0.795_2], 22.0, [2.6, 3.6, 5.2]),
    // Its bright rim: the flashes.
    Mirrored([-0.25, -0.33, 0.910_3], 380.0, [70.0, 82.0, 98.0]),
    // A lamp in the room.
    Mirrored([0.33, 0.18, 0.926_7], 500.0, [60.0, 33.0, 13.0]),
];

/// Fresnel's reflectance of a dielectric, unpolarised, for the cosine of the angle of incidence.
#[inline]
pub(super) fn fresnel(cosine: f32) -> f32 {
    let c = cosine.clamp(0.0, 1.0);
    let refracted = (1.0 - (1.0 - c * c) / (INDEX * INDEX)).max(0.0).sqrt();
    let parallel = (INDEX * c - refracted) / (INDEX * c + refracted);
    let across = (c - INDEX * refracted) / (c + INDEX * refracted);
    0.5 * (parallel * parallel + across * across)
}

/// The normal of a surface with these slopes.
#[inline]
pub(super) fn normal(slope: [f32; 2]) -> Triple {
    let scale = 1.0 / (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
    [-slope[0] * scale, -slope[1] * scale, scale]
}

/// One place of the pane.
pub(super) struct Place {
    /// τ, the share of light that passes unscattered.
    pub passes: f32,
    /// Slopes of the surface in x and y, the lean of the crystal with them.
    pub slope: [f32; 2],
    /// The scene behind, through the ice.
    pub behind: Light,
    /// The same through milk.
    pub glow: Light,
    /// From 0 in a groove to 1 on a ridge.
    pub open: f32,
}

/// What the camera sees.
#[inline]
pub(super) fn seen(place: &Place) -> Light {
    let n = normal(place.slope);
    let key = dot(n, KEY).max(0.0);
    let lamp = dot(n, LAMP).max(0.0);
    let sky = 0.55 - 0.45 * n[1];
    // v is (0, 0, 1).
    let mirror = [2.0 * n[2] * n[0], 2.0 * n[2] * n[1], 2.0 * n[2] * n[2] - 1.0];
    let reflectance = fresnel(n[2]);
    let mut flash = [0.010, 0.013, 0.020];
    for Mirrored(towards, narrow, light) in &MIRRORED {
        let off = 1.0 + narrow * (1.0 - dot(mirror, *towards));
        let lobe = 1.0 / (off * off);
        for (sum, light) in flash.iter_mut().zip(light) {
            *sum += lobe * light;
        }
    }
    let milk = 1.0 - place.passes;
    let mut sum = [0.0; 4];
    for channel in 0..3 {
        let scattered = place.open
            * (key * KEY_LIGHT[channel] + sky * SKY[channel] + lamp * LAMP_LIGHT[channel])
            + 0.55 * place.glow[channel];
        let through = place.passes * place.behind[channel] + milk * scattered;
        sum[channel] = (1.0 - reflectance) * through + reflectance * flash[channel];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresnel_is_that_of_ice() {
        assert!((fresnel(1.0) - 0.018_01).abs() < 1e-5, "((n - 1) / (n + 1))²");
        assert!((fresnel(0.0) - 1.0).abs() < 1e-6);
        // At 60 degrees the refracted ray's cosine is 0.7503: (0.1060 + 0.0046) / 2.
        assert!((fresnel(0.5) - 0.0553).abs() < 1e-4, "{}", fresnel(0.5));
        assert!((0..100).all(|i| fresnel(i as f32 / 100.0) >= fresnel((i + 1) as f32 / 100.0)));
    }

    #[test]
    fn directions_have_length_one() {
        for direction in MIRRORED.iter().map(|mirrored| mirrored.0).chain([KEY, LAMP, normal([0.4, -0.3])]) {
            assert!((dot(direction, direction) - 1.0).abs() < 2e-4, "{direction:?}");
        }
    }
}
