//! Every error of the core's constructors, with its words, in all three arithmetics where it is
//! the same.

use crate::common::make::{Body, Make, Shapes};
use crate::common::scenes::{CAMERA, SCENE};
use whitted::frame::{FrameError, Renderer, Sampling, Settings};
use whitted::math::Fixed;
use whitted::octree::{BuildError, Cube, Extent, Limits, OctreeBuffer, TreeError, build_into};
use whitted::scene::{Falloff, LightSpec, MaterialSpec, Parts, PatternSpec, Scene, SceneError};
use whitted::shape::{MaterialId, ShapeError};
use whitted::trace::Work;

const NAN: f64 = f64::NAN;
const INFINITE: f64 = f64::INFINITY;
/// Neither a number nor in any range.
const ABSURD: [f64; 4] = [NAN, INFINITE, -INFINITE, 1e300];

/// Whether a body is refused, in an arithmetic.
fn refused<A: Make>(body: &Body, material: u16) -> Option<ShapeError> {
    let mut shapes = Shapes::<A>::of(&[], -16);
    A::add(&mut shapes, body, material).err()
}

/// Refused in all arithmetics, for this reason.
fn all_refuse(body: &Body, error: ShapeError) {
    assert_eq!(refused::<Fixed>(body, 0), Some(error), "{body:?}");
    assert_eq!(refused::<f32>(body, 0), Some(error), "{body:?}");
    assert_eq!(refused::<f64>(body, 0), Some(error), "{body:?}");
}

/// Refused in all arithmetics, for whatever reason.
fn none_take(body: &Body) {
    assert!(refused::<Fixed>(body, 0).is_some(), "{body:?}");
    assert!(refused::<f32>(body, 0).is_some(), "{body:?}");
    assert!(refused::<f64>(body, 0).is_some(), "{body:?}");
}

fn square(x: f64) -> Vec<[f64; 3]> {
    vec![[x, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
}

/// A good one of each shape: `x` takes the place of a coordinate, `size` that of a size.
fn bodies(x: f64, size: f64) -> Vec<Body> {
    let corners = [[x, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let up = [0.0, 1.0, 0.0];
    vec![
        Body::Sphere([x, 0.0, 0.0], size),
        Body::Triangle(corners),
        Body::Smooth(corners, [[0.0, 0.0, 1.0]; 3]),
        Body::Polygon(square(x)),
        Body::Cuboid([x, 0.0, 0.0], [1.0, 1.0, size]),
        Body::Disc([x, 0.0, 0.0], up, size),
        Body::Cylinder([x, 0.0, 0.0], up, size),
        Body::Cone([x, 0.0, 0.0], size, up, 0.0),
        Body::Plane(up, x),
    ]
}

#[test]
fn good_shapes_are_taken() {
    for body in bodies(0.0, 1.0) {
        assert_eq!(refused::<Fixed>(&body, 0), None, "{body:?}");
        assert_eq!(refused::<f32>(&body, 0), None, "{body:?}");
        assert_eq!(refused::<f64>(&body, MaterialId::LIMIT - 1), None, "{body:?}");
    }
}

#[test]
fn a_coordinate() {
    for x in ABSURD {
        for body in bodies(x, 1.0) {
            all_refuse(&body, ShapeError::Coordinate);
        }
    }
    for body in bodies(1024.1, 1.0) {
        assert_eq!(refused::<Fixed>(&body, 0), Some(ShapeError::Coordinate), "{body:?}");
    }
    let message = "a coordinate is not a number or out of range";
    assert_eq!(ShapeError::Coordinate.to_string(), message);
}

#[test]
fn a_size() {
    for size in ABSURD.into_iter().chain([0.0, 1e-300]) {
        all_refuse(&Body::Sphere([0.0; 3], size), ShapeError::Size);
        all_refuse(&Body::Disc([0.0; 3], [0.0, 1.0, 0.0], size), ShapeError::Size);
        all_refuse(&Body::Cylinder([0.0; 3], [0.0, 1.0, 0.0], size), ShapeError::Size);
        if size != 1e-300 {
            // a cone may be as thin as a line
            none_take(&Body::Cone([0.0; 3], size, [0.0, 1.0, 0.0], 0.0));
            none_take(&Body::Cone([0.0; 3], 0.0, [0.0, 1.0, 0.0], size));
        }
    }
    // a disc has no inside to show
    all_refuse(&Body::Disc([0.0; 3], [0.0, 1.0, 0.0], -1.0), ShapeError::Size);
    all_refuse(&Body::Cone([0.0; 3], 1.0, [0.0, 1.0, 0.0], -1.0), ShapeError::Size);
    for side in [0.0, -1.0] {
        all_refuse(&Body::Cuboid([0.0; 3], [1.0, side, 1.0]), ShapeError::Size);
    }
    for radius in [1.0 / 4097.0, 501.0] {
        let body = Body::Sphere([0.0; 3], radius);
        assert_eq!(refused::<Fixed>(&body, 0), Some(ShapeError::Size));
        assert_eq!(refused::<f64>(&body, 0), None);
    }
    let message = "a radius or size is not positive or out of range";
    assert_eq!(ShapeError::Size.to_string(), message);
}

#[test]
fn a_direction() {
    for v in [[0.0; 3], [NAN, 0.0, 1.0], [0.0, INFINITE, 0.0], [0.0, 0.0, -INFINITE]] {
        all_refuse(&Body::Plane(v, 0.0), ShapeError::Direction);
        all_refuse(&Body::Disc([0.0; 3], v, 1.0), ShapeError::Direction);
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let up = [0.0, 0.0, 1.0];
        all_refuse(&Body::Smooth(corners, [up, v, up]), ShapeError::Direction);
        let spec = LightSpec::Directional { direction: v, intensity: [1.0; 3] };
        assert_eq!(Fixed::light(&spec).err(), Some(ShapeError::Direction));
        assert_eq!(f64::gradient(v, [0.0; 3], [1.0; 3]).err(), Some(ShapeError::Direction));
        assert_eq!(f32::look_at([0.0; 3], [1.0; 3], v, 0.5).err(), Some(ShapeError::Direction));
    }
    // both ends the same, no view, a view along the vertical
    none_take(&Body::Cylinder([1.0; 3], [1.0; 3], 1.0));
    none_take(&Body::Cone([1.0; 3], 1.0, [1.0; 3], 1.0));
    let up = [0.0, 1.0, 0.0];
    for at in [[0.0; 3], [0.0, 5.0, 0.0], [0.0, -5.0, 0.0]] {
        assert_eq!(Fixed::look_at([0.0; 3], at, up, 0.5).err(), Some(ShapeError::Direction));
    }
    let wide = [17.0, 0.0, 0.0];
    assert_eq!(Fixed::vectors([0.0; 3], up, wide, up).err(), Some(ShapeError::Direction));
    assert_eq!(ShapeError::Direction.to_string(), "a direction is null or not a number");
}

#[test]
fn corners_on_a_line() {
    let line = [[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]];
    for corners in [line, [[2.0; 3]; 3]] {
        all_refuse(&Body::Triangle(corners), ShapeError::Degenerate);
        all_refuse(&Body::Smooth(corners, [[0.0, 0.0, 1.0]; 3]), ShapeError::Degenerate);
        all_refuse(&Body::Polygon(corners.to_vec()), ShapeError::Degenerate);
    }
    assert_eq!(ShapeError::Degenerate.to_string(), "the corners lie on a line");
}

#[test]
fn polygons() {
    let with = |i: usize, corner: [f64; 3]| {
        let mut corners = square(0.0);
        corners[i] = corner;
        Body::Polygon(corners)
    };
    // concave, not plane, too few, too many
    all_refuse(&with(2, [0.2, 0.2, 0.0]), ShapeError::Polygon);
    all_refuse(&with(2, [1.0, 1.0, 0.5]), ShapeError::Polygon);
    for count in [0, 1, 2, 256] {
        let corner = |i: usize| {
            let (s, c) = (i as f64 * std::f64::consts::TAU / 256.0).sin_cos();
            [c, s, 0.0]
        };
        all_refuse(&Body::Polygon((0..count).map(corner).collect()), ShapeError::Polygon);
    }
    let message = "a polygon must be convex, plane, and of 3 to 255 corners";
    assert_eq!(ShapeError::Polygon.to_string(), message);
}

#[test]
fn a_coefficient() {
    fn refuses<A: Make>(spec: &MaterialSpec) {
        assert_eq!(A::material(spec).err(), Some(ShapeError::Coefficient), "{spec:?}");
    }
    let black = MaterialSpec::BLACK;
    for x in ABSURD.into_iter().chain([-0.1, 16.0]) {
        let k = [0.5, x, 0.5];
        let mut specs = vec![
            MaterialSpec { ambient: k, ..black },
            MaterialSpec { diffuse: k, ..black },
            MaterialSpec { specular: k, ..black },
            MaterialSpec { reflection: k, ..black },
            MaterialSpec { transmission: k, ..black },
            MaterialSpec { index_front: x, ..black },
            MaterialSpec { index_behind: x, ..black },
        ];
        if x != 16.0 {
            specs.push(MaterialSpec { shininess: x, ..black });
        }
        for spec in &specs {
            refuses::<Fixed>(spec);
            refuses::<f32>(spec);
            refuses::<f64>(spec);
        }
        if x != 16.0 {
            let position = [1.0; 3];
            let light =
                |intensity| LightSpec::Point { position, intensity, falloff: Falloff::None };
            for intensity in [k, [x; 3]] {
                let error = Fixed::light(&light(intensity)).err();
                assert_eq!(error, Some(ShapeError::Coefficient), "{intensity:?}");
                let error = f64::light(&light(intensity)).err();
                assert_eq!(error, Some(ShapeError::Coefficient), "{intensity:?}");
            }
            assert_eq!(Fixed::uniform(k).err(), Some(ShapeError::Coefficient));
            assert_eq!(Fixed::ambient(k).err(), Some(ShapeError::Coefficient));
            let up = [0.0, 1.0, 0.0];
            assert_eq!(f32::gradient(up, k, [0.0; 3]).err(), Some(ShapeError::Coefficient));
            assert_eq!(f32::gradient(up, [0.0; 3], k).err(), Some(ShapeError::Coefficient));
        }
    }
    refuses::<Fixed>(&MaterialSpec { reflection: [1.01; 3], ..black });
    refuses::<Fixed>(&MaterialSpec { transmission: [1.01; 3], ..black });
    refuses::<Fixed>(&MaterialSpec { index_behind: 0.0, ..black });
    for cell in [NAN, -1.0] {
        let pattern = Some(PatternSpec { cell: [1.0, cell, 1.0], offset: [0.0; 3], other: 0 });
        refuses::<f64>(&MaterialSpec { pattern, ..black });
    }
    for (cos_inner, cos_outer) in
        [(0.5, 0.5), (0.5, 0.7), (1.1, 0.5), (0.5, -0.1), (NAN, 0.5), (0.5, NAN)]
    {
        let spec = LightSpec::Spot {
            position: [0.0; 3],
            direction: [0.0, -1.0, 0.0],
            intensity: [1.0; 3],
            falloff: Falloff::None,
            cos_inner,
            cos_outer,
        };
        assert_eq!(Fixed::light(&spec).err(), Some(ShapeError::Coefficient), "{spec:?}");
    }
    let message = "a coefficient is negative, not a number, or out of range";
    assert_eq!(ShapeError::Coefficient.to_string(), message);
}

#[test]
fn a_camera_or_light_out_of_range() {
    let up = [0.0, 1.0, 0.0];
    for x in ABSURD {
        let p = [0.0, x, 0.0];
        assert!(Fixed::look_at(p, [1.0; 3], up, 0.5).is_err(), "{x}");
        assert!(f64::look_at([1.0; 3], p, up, 0.5).is_err() || x == 1e300, "{x}");
        assert_eq!(Fixed::vectors(p, up, up, up).err(), Some(ShapeError::Coordinate));
        let spec = LightSpec::Point { position: p, intensity: [1.0; 3], falloff: Falloff::None };
        assert_eq!(Fixed::light(&spec).err(), Some(ShapeError::Coordinate));
        assert_eq!(f64::light(&spec).err(), Some(ShapeError::Coordinate));
        let pattern = Some(PatternSpec { cell: [1.0; 3], offset: p, other: 0 });
        let spec = MaterialSpec { pattern, ..MaterialSpec::BLACK };
        assert_eq!(f32::material(&spec).err(), Some(ShapeError::Coordinate));
    }
    for tangent in [0.0, -1.0, 16.0, NAN, INFINITE] {
        let error = Fixed::look_at([0.0; 3], [1.0; 3], up, tangent).err();
        assert_eq!(error, Some(ShapeError::Size), "{tangent}");
    }
}

#[test]
fn a_material_index() {
    for body in bodies(0.0, 1.0) {
        assert_eq!(refused::<Fixed>(&body, MaterialId::LIMIT), Some(ShapeError::Material));
        assert_eq!(refused::<f64>(&body, u16::MAX), Some(ShapeError::Material));
    }
    assert_eq!(ShapeError::Material.to_string(), "a material's index is 32768 or more");
}

/// One scene error for each kind of shape that names what isn't there.
#[test]
fn scenes() {
    let material = [Fixed::material(&MaterialSpec::BLACK).expect("a material")];
    for body in bodies(0.0, 1.0) {
        let shapes = Shapes::<Fixed>::of(&[(body, 1)], -16);
        let parts = Parts { materials: &material, ..shapes.parts() };
        let error = Scene::new(parts).err();
        assert_eq!(error, Some(SceneError::Material { index: 1 }));
        let two = [material[0]; 2];
        assert!(Scene::new(Parts { materials: &two, ..parts }).is_ok());
    }
    let pattern = Some(PatternSpec { cell: [1.0; 3], offset: [0.0; 3], other: 7 });
    let checker = [Fixed::material(&MaterialSpec { pattern, ..MaterialSpec::BLACK }).expect("it")];
    let error = Scene::new(Parts { materials: &checker, ..Parts::EMPTY }).err();
    assert_eq!(error, Some(SceneError::Material { index: 7 }));
    let message = "a shape or a pattern names material 7, which isn't there";
    assert_eq!(error.map(|e| e.to_string()).as_deref(), Some(message));

    let shapes = Shapes::<Fixed>::of(&[(Body::Polygon(square(0.0)), 0)], -16);
    let edges = &shapes.edges[..3];
    let error = Scene::new(Parts { edges, materials: &material, ..shapes.parts() }).err();
    assert_eq!(error, Some(SceneError::Edges { polygon: 0 }));
    let message = "polygon 0 names edges that aren't there";
    assert_eq!(error.map(|e| e.to_string()).as_deref(), Some(message));

    let ball = (Body::Sphere([0.0; 3], 1.0), 0);
    let mut shapes = Shapes::<Fixed>::of(&[ball.clone(), ball.clone()], -16);
    shapes.grow(Limits::DEFAULT);
    let one = Shapes::<Fixed>::of(&[ball], -16);
    let parts = Parts { tree: shapes.parts().tree, materials: &material, ..one.parts() };
    let error = Scene::new(parts).err();
    assert_eq!(error, Some(SceneError::Tree { shapes: 2 }));
    let message = "the octree is over 2 shapes, the scene has another number";
    assert_eq!(error.map(|e| e.to_string()).as_deref(), Some(message));
}

#[test]
fn frames() {
    let error = |settings, samples: usize| {
        let mut work = Work::<Fixed, 5>::new();
        let mut samples = vec![Default::default(); samples];
        let made = Renderer::new(&SCENE, &CAMERA, settings, &mut work, &mut samples);
        made.map(|_| ()).err()
    };
    for (width, height) in [(0, 1), (1, 0), (16_385, 1), (1, 16_385), (u16::MAX, u16::MAX)] {
        assert_eq!(error(Settings::new(width, height), 0), Some(FrameError::Size));
    }
    assert_eq!(error(Settings::new(16_384, 16_384), 0), None);
    for depth in [0, 6, 255] {
        let settings = Settings { depth, ..Settings::new(4, 4) };
        assert_eq!(error(settings, 0), Some(FrameError::Depth { depth, max: 5 }));
    }
    let corners = Settings { sampling: Sampling::Corners, ..Settings::new(4, 4) };
    assert_eq!(error(corners, 5), Some(FrameError::Samples { needed: 6 }));
    assert_eq!(error(corners, 6), None);
    assert_eq!(FrameError::Size.to_string(), "a picture has 1 to 16384 pixels each way");
    let message = FrameError::Depth { depth: 6, max: 5 }.to_string();
    assert_eq!(message, "depth 6 isn't within 1 and the memory's 5");
    let message = FrameError::Samples { needed: 6 }.to_string();
    assert_eq!(message, "this sampling must remember 6 samples");
}

#[test]
fn building_trees() {
    let balls: Vec<_> = (0..40)
        .map(|i| Extent::Sphere {
            center: [i << 18, (i % 7) << 17, (i % 5) << 17],
            radius: 1 << 15,
        })
        .collect();
    let build = |extents: &[Extent], words: usize, scratch: usize| {
        let (mut words, mut scratch) = (vec![0; words], vec![0; scratch]);
        build_into(extents, &mut words, &mut scratch, Limits::DEFAULT).map(|built| built.words)
    };
    let used = build(&balls, 1000, 1000).unwrap();
    assert_eq!(build(&balls, used, 1000), Ok(used));
    for words in [0, 1, used / 2, used - 1] {
        assert_eq!(build(&balls, words, 1000), Err(BuildError::Words));
    }
    for scratch in [0, 39, 41] {
        assert_eq!(build(&balls, 1000, scratch), Err(BuildError::Scratch));
    }
    for extent in [
        Extent::Sphere { center: [1 << 28, 0, 0], radius: 1 },
        Extent::Sphere { center: [0; 3], radius: -1 },
        Extent::Sphere { center: [i32::MAX; 3], radius: i32::MAX },
        Extent::Box { min: [1; 3], max: [0; 3] },
        Extent::Box { min: [i32::MIN; 3], max: [i32::MAX; 3] },
    ] {
        assert_eq!(build(&[extent], 1000, 1000), Err(BuildError::Extent), "{extent:?}");
    }
    // too many shapes take 200 MB of extents: `trees_that_are_none` has that check
    assert!(OctreeBuffer::<8>::try_build(&balls, Limits::DEFAULT).is_err());
    for (error, message) in [
        (BuildError::Words, "too few words for the octree"),
        (BuildError::Scratch, "too little scratch memory to build the octree"),
        (BuildError::Extent, "a shape is out of the octree's range"),
        (BuildError::TooManyShapes, "an octree holds at most 8388607 shapes"),
    ] {
        assert_eq!(error.to_string(), message);
    }
}

/// Words written by hand: see the bit table of the tree's nodes.
#[test]
fn trees_that_are_none() {
    const LEAF: u32 = 1 << 31;
    const MORE: u32 = 1 << 30;
    const EMPTY: u32 = LEAF | (MORE - 1);
    let cube = Cube { origin: [0; 3], log2_side: 20 };
    let inner = |children: u32, first: u32| children << 23 | first;
    // One cell whose side is 128 << 6 steps.
    let grid = 128 << 9 | 6 << 17;
    let of_cell = |words: &[u32]| [&[grid], words].concat();
    let tree = |words: &[u32], shapes| Fixed::octree(words, shapes, &cube, -16).err();
    let error = |words: &[u32], shapes| tree(&of_cell(words), shapes);
    assert_eq!(tree(&[], 0), None);
    assert_eq!(tree(&[grid, 0], 1), None);
    assert_eq!(error(&[EMPTY], 1), None);
    assert_eq!(error(&[inner(1, 2), EMPTY], 1), None);

    assert_eq!(error(&[EMPTY], 1 << 23), Some(TreeError::TooManyShapes));
    assert_eq!(error(&[inner(1, 3), EMPTY], 1), Some(TreeError::Order));
    assert_eq!(error(&[LEAF | MORE | 7, EMPTY], 1), Some(TreeError::Order));
    assert_eq!(error(&[inner(3, 2), EMPTY], 1), Some(TreeError::Truncated));
    assert_eq!(error(&[LEAF | MORE | 2, EMPTY | MORE], 1), Some(TreeError::Truncated));
    assert_eq!(error(&[inner(0, 2)], 1), Some(TreeError::Childless));
    let deep: Vec<_> = (0..13).map(|i| inner(1, i + 2)).chain([EMPTY]).collect();
    assert_eq!(error(&deep, 1), Some(TreeError::TooDeep));
    // three shapes have ids of two bits: the tree over two of them names the third
    let leaf = EMPTY & !(3 ^ 2);
    assert_eq!(error(&[leaf], 3), None);
    assert_eq!(error(&[leaf], 2), Some(TreeError::Id));
    assert_eq!(error(&[EMPTY, EMPTY], 1), Some(TreeError::Length));
    assert_eq!(tree(&[], 1), Some(TreeError::Length));
    // a leaf is no grid, and an inner node has no empty cells
    assert_eq!(tree(&[EMPTY], 1), Some(TreeError::Grid));
    assert_eq!(error(&[inner(1, 2), 0], 1), Some(TreeError::Childless));
    assert_eq!(tree(&[grid], 1), Some(TreeError::Truncated));
    let one = of_cell(&[EMPTY]);
    for cube in [
        Cube { origin: [0; 3], log2_side: 15 },
        Cube { origin: [0; 3], log2_side: 30 },
        Cube { origin: [0, i32::MIN, 0], log2_side: 20 },
    ] {
        assert_eq!(Fixed::octree(&one, 1, &cube, -16).err(), Some(TreeError::Cube));
    }
    assert_eq!(f64::octree(&one, 1, &cube, 100).err(), Some(TreeError::Cube));
    for (error, message) in [
        (TreeError::TooManyShapes, "an octree holds at most 8388607 shapes"),
        (TreeError::Cube, "the octree's cube is out of range"),
        (TreeError::Grid, "the octree's root is not a grid"),
        (TreeError::Order, "a row or run of the octree is out of order"),
        (TreeError::Truncated, "a row or run of the octree is truncated"),
        (TreeError::Childless, "an inner node of the octree has no children"),
        (TreeError::TooDeep, "the octree has too many levels"),
        (TreeError::Id, "the octree names a shape that doesn't exist"),
        (TreeError::Length, "the octree has too many words, or none"),
    ] {
        assert_eq!(error.to_string(), message);
    }
}
