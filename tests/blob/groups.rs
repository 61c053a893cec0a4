//! A blob of what the other has none of: groups, instances, solids and virtual lights.

use super::super::specs::{CORNERS, ERROR, LIGHTS, SETTING};
use super::A;
use super::picture::{assert_shows, read_plainly, setting, shown, written};
use super::tree::{STEP, grown};
use whitted::blob::{BlobError, Content, GroupContent, InstanceSpec, SelectionSpec, SettingSpec};
use whitted::gather::{
    Indirect, VirtualLight, VirtualLightSpec, VirtualLights, VirtualLightsSettings,
    VirtualLightsSpec,
};
use whitted::octree::{Cube, Octree};
use whitted::scene::{
    Group, Instance, Light, Material, MaterialSpec, Parts, Shapes, Transform, uses,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Operand, Plane, Polygon, PolygonEdge, Region, Solid, Sphere,
};

pub(super) struct Grouped {
    spheres: Vec<Sphere<A>>,
    cones: Vec<Cone<A>>,
    polygons: Vec<Polygon<A>>,
    edges: Vec<PolygonEdge<A>>,
    planes: Vec<Plane<A>>,
    /// The first is a group's, the second the scene's.
    solids: [[Solid<A>; 1]; 2],
    operands: [Vec<Operand<A>>; 2],
    words: Vec<u32>,
    cube: Cube,
    lights: Vec<VirtualLight<A>>,
}

pub(super) fn grouped() -> Grouped {
    let ball = |x, y, r, m| Sphere::<A>::new([x, y, 0.0], r, m);
    let operands = [
        vec![
            Operand::Cuboid(Cuboid::<A>::new([-0.4; 3], [0.4; 3], 0)),
            Operand::Sphere(ball(0.0, 0.0, 0.5, 2)),
            Operand::Cylinder(Cylinder::<A>::new([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], 0.2, 2)),
        ],
        vec![
            Operand::Cone(Cone::<A>::new([1.6, 0.0, 3.0], 0.6, [1.6, 1.5, 3.0], 0.2, 0)),
            Operand::HalfSpace(Plane::<A>::new([1.0, 1.0, 0.0], 2.0, 2)),
            Operand::Sphere(Sphere::<A>::new([1.6, 1.5, 3.0], 0.4, 0)),
        ],
    ];
    let [a, b, c] = [0, 1, 2].map(Region::of);
    let solids = [
        [Solid::<A>::new(a.and(b).minus(c), &operands[0], 0, 3)],
        [Solid::<A>::new(a.and(b).or(c), &operands[1], 0, 3)],
    ];
    let lower = CORNERS.map(|[x, y, z]| [x + 1.5, y - 1.0, z - 3.0]);
    let mut made = Grouped {
        spheres: vec![ball(0.9, 0.2, 0.2, 0), ball(-1.4, 0.5, 0.3, 1)],
        cones: vec![Cone::<A>::new([0.5, 0.5, 0.0], 0.2, [0.5, 1.0, 0.0], 0.0, 0)],
        polygons: vec![Polygon::<A>::new(&lower, 0, 0)],
        edges: Polygon::<A>::edges(&lower).to_vec(),
        planes: vec![Plane::<A>::new([0.0, 1.0, 0.0], -0.5, 2)],
        solids,
        operands,
        words: vec![],
        cube: Cube { origin: [0; 3], log2_side: 0 },
        lights: vec![VirtualLight::NONE; 4],
    };
    for (i, place) in made.lights.iter_mut().enumerate().skip(1) {
        *place = VirtualLight::<A>::new(VirtualLightSpec {
            position: [i as f64 - 2.0, 2.5, 3.0],
            normal: [0.0, -0.6, 0.8],
            intensity: 40.0,
            color: [1.0, 0.7, 0.4],
        });
    }
    let parts = Parts::<A> {
        spheres: &made.spheres[..1],
        polygons: &made.polygons,
        cones: &made.cones,
        solids: &made.solids[0],
        ..Parts::EMPTY
    };
    (made.words, made.cube) = grown::<4>(&parts, 2);
    made
}

/// Of the group with a tree, the one without, and the scene.
fn grouped_shapes(of: &Grouped) -> [Shapes<'_, A>; 3] {
    [
        Shapes {
            spheres: &of.spheres[..1],
            polygons: &of.polygons,
            edges: &of.edges,
            cones: &of.cones,
            solids: &of.solids[0],
            operands: &of.operands[0],
            ..Shapes::EMPTY
        },
        Shapes { spheres: &of.spheres[1..], ..Shapes::EMPTY },
        Shapes {
            polygons: &of.polygons,
            edges: &of.edges,
            solids: &of.solids[1],
            operands: &of.operands[1],
            ..Shapes::EMPTY
        },
    ]
}

fn instances() -> [InstanceSpec; 3] {
    let there = Transform::IDENTITY.rotated([1.0, 2.0, 0.5], 40.0);
    [
        InstanceSpec { group: 0, transform: there.moved([-0.4, 1.0, 3.0]), material: None },
        InstanceSpec {
            group: 1,
            transform: Transform::IDENTITY.moved([1.0, 0.5, 2.0]),
            material: None,
        },
        InstanceSpec {
            group: 0,
            transform: there.scaled(0.5).moved([-1.5, 0.5, 2.5]),
            material: Some(2),
        },
    ]
}

const USE: VirtualLightsSpec =
    VirtualLightsSpec { tile: 2, nearest: 0.5, ..VirtualLightsSpec::DEFAULT };
const PLAIN: [MaterialSpec; 3] = [
    MaterialSpec { diffuse: [0.7, 0.3, 0.2], reflection: [0.3; 3], ..MaterialSpec::BLACK },
    MaterialSpec { diffuse: [0.2, 0.6, 0.3], ..MaterialSpec::BLACK },
    MaterialSpec { diffuse: [0.6; 3], ..MaterialSpec::BLACK },
];

/// Passes a content on that borrows what is made for it.
pub(super) fn with_groups<T>(of: &Grouped, then: impl FnOnce(&Content<'_, A>) -> T) -> T {
    let [first, second, own] = grouped_shapes(of);
    then(&Content {
        shapes: own,
        groups: &[
            GroupContent { shapes: first, tree: Some((&of.words, of.cube, STEP)) },
            GroupContent { shapes: second, tree: None },
        ],
        instances: &instances(),
        planes: &of.planes,
        tree: None,
        materials: &PLAIN,
        lights: &LIGHTS[..1],
        absorptions: &[],
        textures: &[],
        area_lights: &[],
        cache: None,
        virtual_lights: Some((&of.lights, USE)),
        setting: SettingSpec { selection: SelectionSpec::All, ..SETTING },
        uses: 0,
    })
}

#[test]
fn groups_solids_and_virtual_lights_are_read_as_they_were_written() {
    let of = grouped();
    let blob = with_groups(&of, written);
    let [mut first, second, own] = grouped_shapes(&of);
    first.tree = Some(Octree::<A>::try_new(&of.words, 4, &of.cube, STEP).unwrap());
    let groups = [Group::<A>::new(first), Group::<A>::new(second)];
    let placed = instances().map(|spec| {
        let instance = Instance::<A>::new(&groups[usize::from(spec.group)], spec.transform);
        spec.material.map_or(instance, |m| instance.with_material(m))
    });
    let settings = VirtualLightsSettings::<A>::new(USE);
    let materials = PLAIN.map(Material::<A>::new);
    let lights = [Light::<A>::new(LIGHTS[0])];
    let parts = Parts {
        polygons: own.polygons,
        edges: own.edges,
        solids: own.solids,
        operands: own.operands,
        instances: &placed,
        planes: &of.planes,
        materials: &materials,
        lights: &lights,
        indirect: Indirect::VirtualLights(VirtualLights::new(&of.lights, &settings)),
        ..setting()
    };
    assert_shows(&blob, parts);
}

#[test]
fn what_is_wrong_with_groups_is_said() {
    let of = grouped();
    let said = |change: &dyn Fn(&mut Content<'_, A>)| {
        with_groups(&of, |content| {
            let mut content = *content;
            change(&mut content);
            shown(written(&content).bytes(), 1).unwrap_err()
        })
    };
    // No such group; a turn that is none; a material that isn't there.
    let change = |to: InstanceSpec| {
        let to: &[_] = Box::leak(Box::new([to]));
        said(&|c| c.instances = to)
    };
    let one = instances()[0];
    assert_eq!(change(InstanceSpec { group: 2, ..one }), BlobError::Parts);
    let bent = Transform { rotation: [[1.0; 3]; 3], ..one.transform };
    let bent = InstanceSpec { transform: bent, ..one };
    assert!(matches!(change(bent), BlobError::Value(_)));
    let bare = InstanceSpec { material: Some(3), ..one };
    assert!(matches!(change(bare), BlobError::Scene(_)));
    let many = said(&|c| {
        c.instances =
            &[InstanceSpec { group: 1, transform: Transform::IDENTITY, material: None }; 4]
    });
    let wanted = BlobError::RoomForGroups { solids: 2, operands: 6, groups: 2, instances: 4 };
    assert_eq!(many, wanted);
    let few = said(&|c| c.groups = &[GroupContent { shapes: Shapes::EMPTY, tree: None }; 2]);
    assert!(matches!(few, BlobError::Scene(_)), "{few}");
    assert_eq!(said(&|c| c.shapes.solids = &[Solid::NONE]), BlobError::Solid);
    let tile = VirtualLightsSpec { tile: 3, ..USE };
    let wrong = said(&|c| c.virtual_lights = Some((&[], tile)));
    assert!(matches!(wrong, BlobError::Value(_)));
    assert_eq!(said(&|c| c.cache = Some((&[], ERROR))), BlobError::Parts);
    // Without room for groups, and with a scene of a type that has none.
    let bare = with_groups(&of, read_plainly::<{ uses::ALL }>);
    assert!(matches!(bare, Err(BlobError::RoomForGroups { .. })));
    let plain = with_groups(&of, read_plainly::<{ uses::VIRTUAL_LIGHTS }>);
    assert!(matches!(plain, Err(BlobError::Scene(_))));
}
