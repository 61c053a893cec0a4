//! Placing a scene into an arithmetic's range.
//!
//! Floating point takes a scene as it is, unless that lies far from the origin or is far from the size
//! that coefficients are made for ([`Placement::near`]). Fixed point has one step everywhere, so a scene is
//! moved to the origin and scaled by a power of two until it fills the range; lengths that the
//! scene states (cells of patterns, positions of lights and camera) follow, and the intensity of a
//! light with falloff grows with the square.
//!
//! What the range is filled with:
//! - The shapes reach from 64 to 128 units from the origin. Where there are endless planes they
//!   reach from 8 to 16: planes have no end, but points on them are exact within the range alone.
//! - Lights and camera lie within ±[`REACH`]. Where one lies farther the scale is smaller.
//! - A light so far that its direction changes by less than [`PARALLEL`] over the whole scene is
//!   made directional, which it is to the eye; anything nearer keeps its place. Moving a light
//!   nearer would change directions by as much as it gains range, so that is never done.

use std::fmt;

use whitted::scene::{Mapping, TextureSpec};

use crate::document::{
    Area, Background, Body, Camera, Document, Falloff, Light, LightKind, Material, Point, length,
    scaled, sub,
};

/// The farthest a light or the camera may lie along an axis: the range is ±1024, and a
/// difference of two positions must stay below 2048.
const REACH: f64 = 1000.0;

/// How far shapes may reach from the origin; endless planes need room beyond.
const SHAPES_REACH: f64 = 128.0;
const WITH_PLANES_REACH: f64 = 16.0;

/// How many times as far from the origin as it is wide a scene may lie for single precision: a
/// position is known to 2⁻¹⁸ of the width.
const FAR: f64 = 64.0;

/// Two to this is how much larger or smaller floating point may want a scene and take it as it is.
const ODD: i32 = 10;

/// The sine of the angle under which a far light may see the scene's radius and be called
/// directional: 2⁻¹², a sixteenth of a grey level at the steepest.
const PARALLEL: f64 = 1.0 / 4096.0;

/// A group's space may be 2 to this larger than the scene's: the core's scales reach a little
/// farther.
const LARGER: i32 = 9;

/// Where a scene lies in its arithmetic: p becomes (p − center)·2^log2_scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The point that comes to the origin.
    pub center: Point,
    /// The scale is 2 to this.
    pub log2_scale: i32,
}

impl fmt::Display for Placement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::IDENTITY {
            return f.write_str("as it is");
        }
        let [x, y, z] = self.center;
        write!(f, "scaled by 2^{} around {x} {y} {z}", self.log2_scale)
    }
}

impl Placement {
    /// The scene as it is.
    pub const IDENTITY: Self = Self { center: [0.0; 3], log2_scale: 0 };

    /// The placement that fills fixed point's range.
    pub fn filling(document: &Document) -> Self {
        let Some(bounds) = document.bounds() else { return Self::IDENTITY };
        let center = bounds.center();
        let planes = document.shapes.iter().any(|s| matches!(s.body, Body::Plane { .. }));
        let half = (bounds.side() / 2.0).max(f64::MIN_POSITIVE);
        let mut log2_scale =
            power_below(if planes { WITH_PLANES_REACH } else { SHAPES_REACH } / half);
        let radius = half * 3f64.sqrt();
        let lights =
            document.lights.iter().filter(|light| planes || !parallel(light, center, radius));
        let positions = lights.flat_map(Light::reach).chain([document.camera.eye]);
        for position in positions {
            let farthest = sub(position, center).map(f64::abs).into_iter().fold(0.0, f64::max);
            if farthest > 0.0 {
                log2_scale = log2_scale.min(power_below(REACH / farthest));
            }
        }
        // Whole units of the new scale: coordinates with few digits keep them.
        let scale = 2f64.powi(log2_scale);
        Self { center: center.map(|x| (x * scale).round() / scale), log2_scale }
    }

    /// The placement for floating point: the scene as it is, unless single precision would lose it, so
    /// far away, or so large or small that absorption leaves its range.
    pub fn near(document: &Document) -> Self {
        let Some(bounds) = document.bounds() else { return Self::IDENTITY };
        let filling = Self::filling(document);
        let away = bounds.center().into_iter().map(f64::abs).fold(0.0, f64::max);
        if away > FAR * bounds.side() || filling.log2_scale.abs() > ODD {
            filling
        } else {
            Self::IDENTITY
        }
    }

    /// The scale.
    pub fn scale(&self) -> f64 {
        2f64.powi(self.log2_scale)
    }

    /// A point.
    pub fn point(&self, p: Point) -> Point {
        scaled(sub(p, self.center), self.scale())
    }

    /// A length.
    pub fn length(&self, l: f64) -> f64 {
        l * self.scale()
    }

    /// A camera.
    #[must_use]
    pub fn camera(&self, camera: &Camera) -> Camera {
        Camera { eye: self.point(camera.eye), look_at: self.point(camera.look_at), ..*camera }
    }

    /// The whole scene. Groups fill the ranges of their own spaces, far lights become directional, even
    /// where the scene itself stays as it is.
    #[must_use]
    pub fn place(&self, document: &Document) -> Document {
        let mut placed = document.clone();
        placed.camera = self.camera(&document.camera);
        placed.materials.iter_mut().for_each(|material| self.material(material));
        // Ways are measured in the scene, within groups too.
        for material in &mut placed.materials {
            for rate in material.absorption.as_flattened_mut() {
                *rate /= self.scale();
            }
        }
        for index in 0..document.groups.len() {
            self.group(document, index, &mut placed);
        }
        for shape in &mut placed.shapes {
            self.body(&mut shape.body);
        }
        let (center, radius) =
            document.bounds().map_or(([0.0; 3], 0.0), |b| (b.center(), b.side() * 0.75f64.sqrt()));
        for light in &mut placed.lights {
            self.light(light, center, radius);
        }
        match &mut placed.background {
            Background::Color(_) | Background::Gradient { .. } => {}
        }
        placed
    }

    fn texture(&self, spec: &mut TextureSpec<'_>) {
        let s = self.scale();
        spec.origin = self.point(spec.origin);
        spec.height *= s;
        match spec.mapping {
            Mapping::Planar => spec.size = scaled(spec.size, s),
            Mapping::Cylindrical => spec.size[1] *= s,
            Mapping::Spherical | Mapping::Uv => {}
        }
    }

    /// What of a material lies in a space.
    fn material(&self, material: &mut Material) {
        for texture in [&mut material.texture, &mut material.bump].into_iter().flatten() {
            self.texture(&mut texture.spec);
        }
        if let Some(checker) = &mut material.checker {
            checker.cell = scaled(checker.cell, self.scale());
            checker.offset = self.point(checker.offset);
            // Twice a cell further on it looks the same; far away it is out of range.
            for (offset, cell) in checker.offset.iter_mut().zip(checker.cell) {
                if offset.abs() > 512.0 {
                    *offset = if cell > 0.0 { offset.rem_euclid(2.0 * cell) } else { 0.0 };
                }
            }
        }
    }

    /// Places a group so that it fills the range of its own space, and its instances. Materials
    /// with patterns, which lie in that space, become materials of the group's own.
    fn group(&self, document: &Document, index: usize, placed: &mut Document) {
        let Some(group) = document.groups.get(index) else { return };
        let Some(bounds) = group.bounds() else { return };
        let instances = || document.instances.iter().filter(|i| i.group == index);
        let scales = instances().filter_map(|i| i.place.uniform_scale());
        let least = scales.fold(f64::MAX, f64::min);
        let half = (bounds.side() / 2.0).max(f64::MIN_POSITIVE);
        let log2_scale =
            power_below(SHAPES_REACH / half).min(self.log2_scale + power_below(least) + LARGER);
        let scale = 2f64.powi(log2_scale);
        let center = bounds.center().map(|x| (x * scale).round() / scale);
        let space = Self { center, log2_scale };

        let mut own: Vec<(usize, usize)> = Vec::new();
        let mut material = |materials: &mut Vec<Material>, old: usize| {
            if let Some((_, new)) = own.iter().find(|(known, _)| *known == old) {
                return *new;
            }
            let Some(original) = document.materials.get(old) else { return old };
            let mut here = original.clone();
            space.material(&mut here);
            let Some(there) = materials.get(old) else { return old };
            here.absorption = there.absorption;
            if *there == here {
                return old;
            }
            materials.push(here);
            own.push((old, materials.len() - 1));
            materials.len() - 1
        };
        for shape in placed.groups.iter_mut().skip(index).take(1).flat_map(|g| &mut g.shapes) {
            space.body(&mut shape.body);
            shape.rename(&mut |old| material(&mut placed.materials, old));
        }
        let ratio = self.scale() / scale;
        for instance in placed.instances.iter_mut().filter(|i| i.group == index) {
            let place = &mut instance.place;
            place.offset = self.point(place.point(center));
            place.columns = place.columns.map(|column| scaled(column, ratio));
            instance.material = instance.material.map(|old| material(&mut placed.materials, old));
        }
    }

    fn light(&self, light: &mut Light, center: Point, radius: f64) {
        if let Some(position) = light.position()
            && self.point(position).iter().any(|x| x.abs() > REACH)
            && parallel(light, center, radius)
        {
            let direction = sub(center, position);
            if light.falloff() == Falloff::InverseSquare {
                let distance = length(direction);
                light.color = light.color.map(|c| c / distance / distance);
            }
            light.kind = LightKind::Directional { direction };
            return;
        }
        match &mut light.kind {
            LightKind::Directional { .. } => {}
            LightKind::Area { area, .. } => self.area(area),
            LightKind::Point { position, falloff } | LightKind::Spot { position, falloff, .. } => {
                *position = self.point(*position);
                if *falloff == Falloff::InverseSquare {
                    light.color = light.color.map(|c| c * self.scale() * self.scale());
                }
            }
        }
    }

    fn area(&self, area: &mut Area) {
        let s = self.scale();
        match area {
            Area::Rectangle { corner, edges } => {
                *corner = self.point(*corner);
                *edges = edges.map(|edge| scaled(edge, s));
            }
            Area::Triangle { corners } => *corners = corners.map(|c| self.point(c)),
            Area::Polygon { corners } => corners.iter_mut().for_each(|c| *c = self.point(*c)),
            Area::Disc { center, radius, .. } | Area::Sphere { center, radius } => {
                *center = self.point(*center);
                *radius *= s;
            }
        }
    }

    fn body(&self, body: &mut Body) {
        let s = self.scale();
        match body {
            Body::Sphere { center, radius } | Body::Disc { center, radius, .. } => {
                *center = self.point(*center);
                *radius *= s;
            }
            Body::Plane { point, .. } => *point = self.point(*point),
            Body::Box { low, high } => {
                *low = self.point(*low);
                *high = self.point(*high);
            }
            Body::Triangle { corners } | Body::SmoothTriangle { corners, .. } => {
                *corners = corners.map(|c| self.point(c));
            }
            Body::Polygon { corners } => corners.iter_mut().for_each(|c| *c = self.point(*c)),
            Body::Cylinder { base, apex, radius, .. } => {
                *base = self.point(*base);
                *apex = self.point(*apex);
                *radius *= s;
            }
            Body::Cone { base, base_radius, apex, apex_radius, .. } => {
                *base = self.point(*base);
                *apex = self.point(*apex);
                *base_radius *= s;
                *apex_radius *= s;
            }
            Body::Solid(solid) => {
                solid.operands.iter_mut().for_each(|operand| self.body(&mut operand.body));
            }
        }
    }
}

/// Whether a point light's rays are parallel over the scene. A spot's cone has an edge that
/// would move.
fn parallel(light: &Light, center: Point, radius: f64) -> bool {
    match light.kind {
        LightKind::Area { .. } => false,
        LightKind::Point { position, .. } => radius < PARALLEL * length(sub(position, center)),
        LightKind::Directional { .. } | LightKind::Spot { .. } => false,
    }
}

/// The largest n with 2ⁿ ≤ x, within what any scene can need.
fn power_below(x: f64) -> i32 {
    (x.log2().floor() as i32).clamp(-60, 60)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{Format, parse};

    fn document(light: &str, more: &str) -> Document {
        let text = format!(
            "[camera]\neye = [100, 20, 95]\nlook_at = [100, 20, 100]\n{light}\n\
             [[material]]\nname = \"a\"\ndiffuse = 0.5\n\
             [[sphere]]\ncenter = [100, 20, 100]\nradius = 1.5\n{more}"
        );
        parse(Format::Toml, text.as_bytes()).unwrap_or_else(|flaw| panic!("{}", flaw.problem))
    }

    fn light(text: &str) -> String {
        format!("[[light]]\n{text}")
    }

    #[test]
    fn shapes_fill_the_range_around_the_origin() {
        let document = document(&light("position = [100, 30, 100]\nintensity = 8"), "");
        let placement = Placement::filling(&document);
        assert_eq!(placement, Placement { center: [100.0, 20.0, 100.0], log2_scale: 6 });
        let placed = placement.place(&document);
        assert_eq!(placed.shapes[0].body, Body::Sphere { center: [0.0; 3], radius: 96.0 });
        assert_eq!(placed.camera.eye, [0.0, 0.0, -320.0]);
        assert_eq!(placed.lights[0].position(), Some([0.0, 640.0, 0.0]));
        // 64 times as far, 1/64² of the light: the intensity makes up for it.
        assert_eq!(placed.lights[0].color, [8.0 * 4096.0; 3]);
    }

    #[test]
    fn endless_planes_keep_the_horizon_away() {
        let plane = "[[plane]]\npoint = [0, 18, 0]\nnormal = [0, 1, 0]\n";
        assert_eq!(Placement::filling(&document("", plane)).log2_scale, 3);
    }

    #[test]
    fn a_far_light_makes_the_scale_smaller() {
        let document = document(&light("position = [100, 220, 100]\nfalloff = \"none\""), "");
        let placement = Placement::filling(&document);
        assert_eq!(placement.log2_scale, 2);
        let position = placement.place(&document).lights[0].position();
        assert_eq!(position, Some([0.0, 800.0, 0.0]));
    }

    /// Wherever a scene lies and whatever its unit, it looks the same in all arithmetics.
    #[test]
    fn far_and_tiny_scenes_are_moved_and_scaled_for_floating_point_too() {
        use crate::bake::{Baked, Construct};
        use crate::document::Size;
        use crate::render::{Sampling, Settings, render};
        fn picture<A: Construct>(document: &Document) -> Vec<u8> {
            let settings = Settings {
                size: Size { width: 24, height: 16 },
                depth: 5,
                sampling: Sampling::Center,
                indirect: None,
                show: None,
                threads: std::num::NonZeroUsize::MIN,
            };
            let made =
                Baked::<A>::new(document).and_then(|baked| render(&baked, &settings, |_| {}));
            let made = made.unwrap_or_else(|flaw| panic!("{}: {}", A::NAME, flaw.problem));
            made.picture.pixels().as_flattened().to_vec()
        }
        let scene = |unit: f64, away: f64| {
            let at = |p: [f64; 3]| p.map(|x| (x * unit + away).to_string()).join(", ");
            let text = format!(
                "ambient = 0.3\n[camera]\neye = [{}]\nlook_at = [{}]\n\
                 [[light]]\nposition = [{}]\nintensity = {}\n\
                 [[material]]\nname = \"a\"\ndiffuse = [0.8, 0.3, 0.2]\n\
                 [[material]]\nname = \"g\"\ntransmission = 0.9\nindex = 1.4\nabsorption = {}\n\
                 [[sphere]]\nmaterial = \"a\"\ncenter = [{}]\nradius = {unit}\n\
                 [[sphere]]\nmaterial = \"g\"\ncenter = [{}]\nradius = {unit}\n",
                at([0.0, 2.0, -8.0]),
                at([0.0, 0.5, 0.0]),
                at([5.0, 9.0, -6.0]),
                100.0 * unit * unit,
                0.5 / unit,
                at([0.0, 1.0, 0.0]),
                at([2.0, 1.0, -1.0]),
            );
            parse(Format::Toml, text.as_bytes()).unwrap_or_else(|flaw| panic!("{}", flaw.problem))
        };
        let plain = scene(1.0, 0.0);
        assert_eq!(Placement::near(&plain), Placement::IDENTITY);
        let wanted = picture::<f64>(&plain);
        for (unit, away) in [(0.01, 1e5), (1e-3, 0.0), (1e-6, 0.0), (1e-3, 1e6)] {
            let document = scene(unit, away);
            assert_ne!(Placement::near(&document), Placement::IDENTITY, "{unit} {away}");
            for picture in [picture::<f32>(&document), picture::<f64>(&document)] {
                let off = picture.iter().zip(&wanted).filter(|(a, b)| a.abs_diff(**b) > 2).count();
                assert!(off <= 6, "{unit} {away}: {off} channels of {}", wanted.len());
            }
        }
    }

    /// A scene that needs neither move nor scale has lights and groups all the same.
    #[test]
    fn what_fits_as_it_is_has_its_lights_and_groups_placed() {
        let text = "[camera]\neye = [0, 0, -300]\nlook_at = [0, 0, 0]\n\
                    [[light]]\nposition = [0, 9e6, 0]\nfalloff = \"none\"\n\
                    [[material]]\nname = \"a\"\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 100\n\
                    [[group]]\nname = \"g\"\n[[group.sphere]]\ncenter = [5e4, 0, 0]\nradius = 8e3\n\
                    [[instance]]\ngroup = \"g\"\nscale = 1e-3\n";
        let document = parse(Format::Toml, text.as_bytes()).unwrap_or_else(|f| panic!("{f:?}"));
        let placement = Placement::filling(&document);
        assert_eq!(placement, Placement::IDENTITY);
        let placed = placement.place(&document);
        assert_eq!(placed.shapes, document.shapes);
        assert!(matches!(placed.lights[0].kind, LightKind::Directional { .. }));
        let Body::Sphere { radius, .. } = placed.groups[0].shapes[0].body else { panic!() };
        assert!((64.0..=128.0).contains(&radius), "{radius}");
        crate::bake::Baked::<whitted::math::Fixed>::new(&document)
            .unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    }

    #[test]
    fn a_light_at_the_horizon_of_all_is_directional() {
        let document = document(&light("position = [100, 31643, 100]\nintensity = 1e9"), "");
        let placement = Placement::filling(&document);
        assert_eq!(placement.log2_scale, 6);
        let placed = placement.place(&document);
        let light = &placed.lights[0];
        assert!(matches!(light.kind, LightKind::Directional { direction } if direction[1] < 0.0));
        assert!((light.color[0] - 1e9 / 31623f64.powi(2)).abs() < 1e-9);
    }
}
