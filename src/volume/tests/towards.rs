//! Depths towards a light, against rays.

use super::vector::unit;
use super::*;

fn error(field: &Density, depths: &Depths, direction: [f64; 3]) -> f64 {
    let bricks = Bricks::new(field);
    let mut sum = 0.0;
    for k in 0..400 {
        let place = [0, 1, 2].map(|axis| noise(900 + 3 * k + axis));
        let off = depths.at(place) - bricks.depth(&Ray::new(place, direction).unwrap());
        sum += off * off;
    }
    (sum / 400.0).sqrt()
}

const DIRECTIONS: [[f64; 3]; 8] = [
    [0.3, -0.5, 0.8],
    [-0.9, 0.4, 0.3],
    [0.2, -0.7, -0.6],
    [0.1, 0.05, -1.0],
    [0.7, -0.1, 0.2],
    [1.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [0.0, 1.0, 0.3],
];

/// A smooth field: linear interpolation is of order 2, a quarter of the error for half the voxel (a third is asked for, to
/// allow for places). It errs by up to h^2 / 8 of the second derivatives: those of a bump are 54, there are 1.5 of it, it
/// is 0.36 deep and there are two directions across: 58 h^2 / 8. In thirds of a voxel a ninth is left; a quarter is asked
/// for.
#[test]
fn they_converge_to_rays_with_order_2() {
    let smooth = |n: usize| {
        Density::sampled([n; 3], 1.0 / n as f64, |place| {
            let bump = |x: f64, at: f64| {
                let y = (1.0 - 9.0 * (x - at) * (x - at)).max(0.0);
                y * y * y
            };
            place.map(|x| bump(x, 0.5)).iter().product::<f64>()
                + 0.5 * bump(place[0], 0.6) * bump(place[1], 0.4) * bump(place[2], 0.45)
        })
        .unwrap()
    };
    let fields = [16, 32, 64].map(smooth);
    for direction in DIRECTIONS {
        let coarse = |field| Depths::through(field, 1.0, unit("light", direction).unwrap());
        let errors = [0, 1, 2].map(|k: usize| error(&fields[k], &coarse(&fields[k]), direction));
        assert!(errors[0] > 3.0 * errors[1] && errors[1] > 3.0 * errors[2], "{direction:?} {errors:?}");
        assert!(errors[2] < 58.0 / 8.0 / 4096.0, "{direction:?} {errors:?}");
        for (field, coarse) in fields.iter().zip(errors) {
            let fine = error(field, &Depths::finely(field, direction).unwrap(), direction);
            assert!(fine < 0.25 * coarse, "{direction:?} {fine} {coarse}");
        }
    }
}

/// Along an axis a line of centres is a ray of the lattice and planes between centres are slices, so places there are
/// exact to single precision, in the outer half voxels too.
#[test]
fn they_are_exact_along_an_axis() {
    let field = random(12);
    let bricks = Bricks::new(&field);
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut direction = [0.0; 3];
            direction[axis] = sign;
            let depths = Depths::toward(&field, direction).unwrap();
            for k in 0..200 {
                let mut place = [0, 1, 2].map(|j| noise(3 * k + j));
                place[axis] = ((place[axis] * 12.0).floor() + 0.5) / 12.0;
                is(depths.at(place), bricks.depth(&Ray::new(place, direction).unwrap()), 1e-6);
                place[axis] = if sign > 0.0 { 0.99 } else { 0.01 };
                is(depths.at(place), bricks.depth(&Ray::new(place, direction).unwrap()), 1e-6);
            }
        }
    }
}

/// The shadow of a small block is as sharp far away as near it: the error does not grow with the distance (a fifth is
/// allowed for where the places lie).
#[test]
fn nothing_spreads() {
    let field = Density::sampled([64, 24, 96], 0.01, |[x, y, z]| {
        f64::from(x > 0.49 && x < 0.55 && y > 0.09 && y < 0.15 && z > 0.86 && z < 0.92)
    })
    .unwrap();
    let direction = [0.5, 0.07, 0.8];
    let (depths, bricks) = (Depths::toward(&field, direction).unwrap(), Bricks::new(&field));
    let worst = |z: f64| {
        let mut sum = 0.0;
        for k in 0..4000 {
            let back = (z - 0.89) / 0.8;
            let [u, v] = [0.12 * (noise(2 * k) - 0.5), 0.12 * (noise(2 * k + 1) - 0.5)];
            let place = [0.52 + 0.5 * back + u, 0.12 + 0.07 * back + v, z];
            let off = depths.at(place) - bricks.depth(&Ray::new(place, direction).unwrap());
            sum += off * off;
        }
        (sum / 4000.0).sqrt()
    };
    let [near, far] = [worst(0.8), worst(0.15)];
    assert!(far < 1.2 * near && near < 0.003, "{near} {far}");
}

/// A uniform box: the depth is linear in cells of the lattice, but for those in which the shadow of an edge is; a third of
/// these are within three voxels of one. There it errs by at most a voxel's depth across its side; elsewhere by rounding.
#[test]
fn a_uniform_box_has_its_sides() {
    let field = uniform([24; 3], 1.0 / 24.0, 1.0);
    let bricks = Bricks::new(&field);
    for direction in DIRECTIONS {
        let depths = Depths::toward(&field, direction).unwrap();
        let mut exact = 0;
        for k in 0..400 {
            let place = [0, 1, 2].map(|axis| noise(900 + 3 * k + axis));
            let off = (depths.at(place) - bricks.depth(&Ray::new(place, direction).unwrap())).abs();
            exact += u32::from(off < 1e-6);
            assert!(off < 0.5, "{direction:?} {place:?} {off}");
        }
        println!("{direction:?} {exact}");
        assert!(exact > 200, "{direction:?} {exact}");
    }
    assert!(Depths::toward(&field, [0.0; 3]).is_err());
}
