//! A blob of every kind of shape, material, texture and light, with a tree and irradiance records.

use super::super::aligned::Aligned;
use super::super::specs::{
    ABSORPTIONS, AREA_LIGHTS, CORNERS, ERROR, LAMP, LIGHTS, MATERIALS, RECORDS, SETTING, TEXTURES,
    TRIANGLE, UV,
};
use super::A;
use super::picture::{assert_shows, read_plainly, setting, shown, written};
use super::tree::{STEP, grown};
use whitted::blob::{ALIGNMENT, BlobError, Content};
use whitted::gather::{Indirect, IrradianceCache, Record};
use whitted::octree::{Cube, Octree};
use whitted::scene::{
    Absorption, AreaLight, Light, Material, MaterialSpec, Parts, Selection, Shapes, Texture,
    TextureSpec, TriangleUv, uses,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
};

pub(super) struct Kinds {
    spheres: Vec<Sphere<A>>,
    triangles: Vec<Triangle<A>>,
    smooth: Vec<SmoothTriangle<A>>,
    polygons: Vec<Polygon<A>>,
    edges: Vec<PolygonEdge<A>>,
    cuboids: Vec<Cuboid<A>>,
    discs: Vec<Disc<A>>,
    cylinders: Vec<Cylinder<A>>,
    cones: Vec<Cone<A>>,
    planes: Vec<Plane<A>>,
    uvs: Vec<TriangleUv>,
    records: Vec<Record<A>>,
    words: Vec<u32>,
    cube: Cube,
}

pub(super) fn kinds() -> Kinds {
    let normals = [[-0.2, 0.0, -1.0], [0.2, 0.0, -1.0], [0.0, 0.3, -1.0]];
    let up = [0.0, 1.0, 0.0];
    let mut kinds = Kinds {
        spheres: vec![
            Sphere::<A>::new([0.0, 0.6, 3.0], 0.6, 1),
            Sphere::<A>::new([0.8, 0.3, 2.0], -0.3, 0),
        ],
        triangles: vec![Triangle::<A>::new(TRIANGLE, 0)],
        smooth: vec![SmoothTriangle::<A>::new(
            TRIANGLE.map(|c| [c[0], c[1] + 1.0, c[2]]),
            normals,
            0,
        )],
        polygons: vec![Polygon::<A>::new(&CORNERS, 0, 0)],
        edges: Polygon::<A>::edges(&CORNERS).to_vec(),
        cuboids: vec![Cuboid::<A>::new([-1.0, 0.0, 4.0], [-0.5, 0.5, 4.5], 0)],
        discs: vec![Disc::<A>::new([0.0, 0.01, 3.0], up, 1.0, 2)],
        cylinders: vec![Cylinder::<A>::new([1.0, 0.0, 5.0], [1.0, 1.0, 5.0], 0.2, 0)],
        cones: vec![Cone::<A>::new([-1.5, 1.0, 4.0], 0.3, [-1.5, 2.0, 4.0], 0.0, 0)],
        planes: vec![Plane::<A>::new(up, -0.01, 2)],
        uvs: vec![TriangleUv::new(UV); 2],
        records: RECORDS.map(Record::<A>::new).to_vec(),
        words: vec![],
        cube: Cube { origin: [0; 3], log2_side: 0 },
    };
    let parts = Parts::<A> {
        spheres: &kinds.spheres,
        triangles: &kinds.triangles,
        smooth_triangles: &kinds.smooth,
        polygons: &kinds.polygons,
        cuboids: &kinds.cuboids,
        discs: &kinds.discs,
        cylinders: &kinds.cylinders,
        cones: &kinds.cones,
        ..Parts::EMPTY
    };
    (kinds.words, kinds.cube) = grown::<9>(&parts, 3);
    kinds
}

pub(super) fn content(kinds: &Kinds) -> Content<'_, A> {
    Content {
        shapes: Shapes {
            spheres: &kinds.spheres,
            triangles: &kinds.triangles,
            smooth_triangles: &kinds.smooth,
            polygons: &kinds.polygons,
            edges: &kinds.edges,
            cuboids: &kinds.cuboids,
            discs: &kinds.discs,
            cylinders: &kinds.cylinders,
            cones: &kinds.cones,
            uvs: &kinds.uvs,
            ..Shapes::EMPTY
        },
        planes: &kinds.planes,
        tree: Some((&kinds.words, kinds.cube, STEP)),
        materials: &MATERIALS,
        lights: &LIGHTS,
        absorptions: &ABSORPTIONS,
        textures: &TEXTURES,
        area_lights: &AREA_LIGHTS,
        cache: Some((&kinds.records, ERROR)),
        groups: &[],
        instances: &[],
        virtual_lights: None,
        setting: SETTING,
        uses: 0,
    }
}

#[test]
fn what_was_written_is_what_is_read() {
    let kinds = kinds();
    let content = content(&kinds);
    let blob = written(&content);
    assert!(blob.bytes().len().is_multiple_of(ALIGNMENT));
    let materials = MATERIALS.map(Material::<A>::new);
    let lights = LIGHTS.map(Light::<A>::new);
    let tree = Octree::<A>::try_new(&kinds.words, 9, &kinds.cube, STEP).unwrap();
    let textures = TEXTURES.map(Texture::<A>::new);
    let absorptions = ABSORPTIONS.map(|[a, b]| Absorption::<A>::new(a, b));
    let fan = AreaLight::<A>::fan::<3>(&LAMP);
    let area_lights = AREA_LIGHTS.map(|spec| AreaLight::<A>::new(spec));
    let parts = Parts {
        uvs: &kinds.uvs,
        textures: &textures,
        absorptions: &absorptions,
        area_lights: &area_lights,
        light_corners: &fan,
        selection: Selection::<A>::above(0.001),
        indirect: Indirect::Cache(IrradianceCache::<A>::new(&kinds.records, ERROR)),
        spheres: &kinds.spheres,
        triangles: &kinds.triangles,
        smooth_triangles: &kinds.smooth,
        polygons: &kinds.polygons,
        edges: &kinds.edges,
        cuboids: &kinds.cuboids,
        discs: &kinds.discs,
        cylinders: &kinds.cylinders,
        cones: &kinds.cones,
        planes: &kinds.planes,
        tree: Some(tree),
        materials: &materials,
        lights: &lights,
        ..setting()
    };
    assert_shows(&blob, parts);
}

#[test]
fn what_is_wrong_is_said() {
    let kinds = kinds();
    let content = content(&kinds);
    let says = |change: &dyn Fn(&mut Aligned)| {
        let mut blob = written(&content);
        change(&mut blob);
        blob.seal();
        shown(blob.bytes(), 1).unwrap_err()
    };
    assert_eq!(says(&|b| b.set(0, 0)), BlobError::Magic);
    assert_eq!(says(&|b| b.set(8, 9)), BlobError::Version { found: 9 });
    assert_eq!(says(&|b| b.set(10, 3)), BlobError::Arithmetic { found: 3 });
    assert_eq!(says(&|b| b.set(20, 3)), BlobError::Layout);
    assert_eq!(says(&|b| b.set(51, 0x7f)), BlobError::Parts);
    let few = Content { materials: &MATERIALS[..2], ..content };
    assert!(matches!(shown(written(&few).bytes(), 1), Err(BlobError::Scene(_))));
    let many = Content { lights: &[LIGHTS[0]; 5], ..content };
    let room = BlobError::Room { materials: 3, lights: 5 };
    assert_eq!(shown(written(&many).bytes(), 1), Err(room));
    let none = read_plainly::<{ uses::ALL }>(&content);
    let wanted = BlobError::RoomBesides { area_lights: 2, fans: 3, textures: 3, absorptions: 1 };
    assert_eq!(none, Err(wanted));
    let few = Content { textures: &TEXTURES[..2], ..content };
    assert!(matches!(shown(written(&few).bytes(), 1), Err(BlobError::Scene(_))));
    let steep = TextureSpec { height: f64::NAN, ..TEXTURES[2] };
    let bad = Content { textures: &[TEXTURES[0], TEXTURES[1], steep], ..content };
    assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
    let bad = Content { absorptions: &[[[-1.0; 3]; 2]], ..content };
    assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
    let bad = Content { cache: Some((&kinds.records, 7.0)), ..content };
    assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
    let bad = Content { cache: Some((&[Record::NONE], ERROR)), ..content };
    assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Shape { .. })));
    let dark = MaterialSpec { reflection: [2.0; 3], ..MATERIALS[0] };
    let bad = Content { materials: &[dark; 3], ..content };
    assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
    let mut shifted = written(&content).bytes().to_vec();
    shifted.insert(0, 0);
    let shifted = Aligned::of(&shifted);
    let error = shown(&shifted.bytes()[1..], 1);
    assert_eq!(error, Err(BlobError::Alignment));
}
