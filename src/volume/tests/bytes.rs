//! The same bytes on any number of threads, and whether empty space is skipped or not.

use super::*;

fn lit() -> [Shading; 4] {
    let to_sun = [0.3, -0.5, 0.8];
    let octaves = Octaves { sun: [3.0, 2.0, 1.0], ..octaves::lit(0.5, 0.5, false) };
    let himeno = Himeno {
        diffuse: 0.5,
        specular: 0.3,
        power: 5,
        ambient: 0.2,
        to_light: to_sun,
        light: [1.0; 3],
        ambient_light: [1.0; 3],
    };
    [Shading::Emission([1.0; 3]), isotropic(to_sun), Shading::Himeno(himeno), Shading::Octaves(octaves)]
}

fn cameras(field: &Density) -> Vec<Camera> {
    let size = [37, 29];
    let up = [0.0, 0.0, 1.0];
    let mut all: Vec<Camera> =
        [[1.0, 0.2, -0.3], [-0.3, -0.8, 0.5], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]]
            .into_iter()
            .map(|view| Camera::orthographic(field, view, up, size).unwrap())
            .collect();
    all.push(Camera::pinhole([0.5, 0.4, 0.55], [0.3, 1.0, 0.1], up, 70.0, size).unwrap());
    all.push(Camera::pinhole([2.0, -1.0, 0.5], [-1.0, 1.0, 0.0], up, 40.0, size).unwrap());
    all
}

#[test]
fn threads_do_not_matter() {
    let field = ragged(32);
    let camera = cameras(&field)[0];
    for shading in lit() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&field, 25.0, &camera, &shading, 2).unwrap())
        };
        let one = with(1);
        assert!(one.work.skipped > 0 && one.work.cells > 0);
        for threads in [2, 7] {
            let other = with(threads);
            assert_eq!(one.work, other.work);
            let bits = |picture: &Rendered| -> Vec<u32> {
                picture.radiance.iter().flatten().chain(&picture.transmittance).map(|x| x.to_bits()).collect()
            };
            assert_eq!(bits(&one), bits(&other));
        }
    }
}

#[test]
fn skipping_does_not_matter() {
    // Much is empty, on all sides and within, in a box that is no multiple of a brick.
    let all = ragged(45);
    let values = all.values().iter().enumerate().map(|(k, value)| {
        let place = [k % 45, k / 45 % 45, k / 2025];
        let inside = place[0] > 9 && place[1] < 34 && (17..40).contains(&place[2]);
        if inside { *value } else { 0.0 }
    });
    let field = Density::new([45; 3], 1.0 / 45.0, values.collect()).unwrap();
    for shading in lit() {
        let [with, without] = [true, false]
            .map(|skip| Renderer::with_bricks(&field, Bricks::build(&field, skip), 40.0, &shading).unwrap());
        for camera in cameras(&field) {
            let [a, b] = [&with, &without].map(|renderer| renderer.picture(&camera, 1).unwrap());
            assert_eq!(a.radiance, b.radiance);
            assert_eq!(a.transmittance, b.transmittance);
            assert!(a.work.cells < b.work.cells && b.work.skipped == 0);
            assert!(a.transmittance.iter().any(|value| *value < 0.9));
        }
    }
}
