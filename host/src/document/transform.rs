//! Placing what a file describes somewhere else: turned, scaled, mirrored, moved.
//!
//! A transform is p ↦ M·p + t. Directions go by M, normals by the inverse transpose of M, so that
//! they stay perpendicular to what they were perpendicular to.

use super::{Point, add, cross, dot, length, scaled};

/// Rounding of this part of a length doesn't count.
const NEARLY: f64 = 1e-9;

/// p ↦ M·p + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The columns of M: where the axes go.
    pub columns: [Point; 3],
    /// t: where the origin goes.
    pub offset: Point,
}

impl Transform {
    /// Everything stays where it is.
    pub const IDENTITY: Self =
        Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], offset: [0.0; 3] };

    /// Moves by `offset`.
    pub fn moved(offset: Point) -> Self {
        Self { offset, ..Self::IDENTITY }
    }

    /// Scales along the axes, about the origin.
    pub fn scaled([x, y, z]: Point) -> Self {
        let columns = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        Self { columns, ..Self::IDENTITY }
    }

    /// Turns about an axis through the origin, counter-clockwise seen from its tip (Rodrigues).
    /// A null axis turns nothing.
    pub fn turned(axis: Point, degrees: f64) -> Self {
        let Some(n) = super::normalized(axis) else { return Self::IDENTITY };
        let (sine, cosine) = sine_cosine(degrees);
        let columns = Self::IDENTITY.columns.map(|e| {
            let along = scaled(n, dot(n, e) * (1.0 - cosine));
            add(add(scaled(e, cosine), scaled(cross(n, e), sine)), along)
        });
        Self { columns, ..Self::IDENTITY }
    }

    /// Turns about x, then y, then z, by degrees.
    pub fn turned_about_axes([x, y, z]: Point) -> Self {
        let [ex, ey, ez] = Self::IDENTITY.columns;
        Self::turned(ex, x).then(&Self::turned(ey, y)).then(&Self::turned(ez, z))
    }

    /// This one first, `next` after it.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { columns: self.columns.map(|c| next.direction(c)), offset: next.point(self.offset) }
    }

    /// This one, done about another point than the origin.
    #[must_use]
    pub fn about(&self, pivot: Point) -> Self {
        Self::moved(scaled(pivot, -1.0)).then(self).then(&Self::moved(pivot))
    }

    /// Where a point goes.
    pub fn point(&self, p: Point) -> Point {
        add(self.direction(p), self.offset)
    }

    /// What a way from one point to another becomes.
    pub fn direction(&self, [x, y, z]: Point) -> Point {
        let [a, b, c] = self.columns;
        add(add(scaled(a, x), scaled(b, y)), scaled(c, z))
    }

    /// What a normal becomes, not of the same length: by the cofactors of M, which are the inverse
    /// transpose times the determinant.
    pub fn normal(&self, [x, y, z]: Point) -> Point {
        let [a, b, c] = self.columns;
        let n = add(add(scaled(cross(b, c), x), scaled(cross(c, a), y)), scaled(cross(a, b), z));
        if self.mirrors() { scaled(n, -1.0) } else { n }
    }

    /// The determinant of M: by how much volumes grow.
    pub fn determinant(&self) -> f64 {
        let [a, b, c] = self.columns;
        dot(a, cross(b, c))
    }

    /// Whether left and right are exchanged.
    pub fn mirrors(&self) -> bool {
        self.determinant() < 0.0
    }

    /// By how much lengths grow, if they all grow by the same.
    pub fn uniform_scale(&self) -> Option<f64> {
        let [a, b, c] = self.columns;
        let s = length(a);
        let same = |v| (length(v) - s).abs() <= NEARLY * s;
        let square = |u, v| dot(u, v).abs() <= NEARLY * s * s;
        (same(b) && same(c) && square(a, b) && square(a, c) && square(b, c)).then_some(s)
    }

    /// By how much a circle about `axis` grows, if it stays a circle.
    pub fn circle_scale(&self, axis: Point) -> Option<f64> {
        let n = super::normalized(axis)?;
        let least = (0..3).min_by(|&i, &j| n[i].abs().total_cmp(&n[j].abs()))?;
        let mut other = [0.0; 3];
        other[least] = 1.0;
        let u = super::normalized(cross(n, other))?;
        let v = cross(n, u);
        let (u, v) = (self.direction(u), self.direction(v));
        let s = length(u);
        ((length(v) - s).abs() <= NEARLY * s && dot(u, v).abs() <= NEARLY * s * s).then_some(s)
    }

    /// Whether what is perpendicular to `axis` stays so: a cylinder isn't sheared.
    pub fn keeps_square_to(&self, axis: Point) -> bool {
        let (turned, normal) = (self.direction(axis), self.normal(axis));
        length(cross(turned, normal)) <= NEARLY * length(turned) * length(normal)
    }

    /// Whether boxes along the axes stay such.
    pub fn keeps_axes(&self) -> bool {
        self.columns.iter().all(|c| c.iter().filter(|x| **x != 0.0).count() == 1)
    }
}

/// Exact at right angles, so that boxes stay boxes.
fn sine_cosine(degrees: f64) -> (f64, f64) {
    let turn = degrees.rem_euclid(360.0);
    match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turn.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::sub;

    fn near(a: Point, b: Point) -> bool {
        length(sub(a, b)) < 1e-12
    }

    #[test]
    fn turns_are_right_handed_and_in_order() {
        assert_eq!(Transform::turned([0.0, 0.0, 2.0], 90.0).point([1.0, 0.0, 0.0]), [0., 1., 0.]);
        // about x: y to z; then about y: z to x
        let both = Transform::turned_about_axes([90.0, 90.0, 0.0]);
        assert_eq!(both.point([0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]);
        let third = Transform::turned([1.0, 1.0, 1.0], 120.0);
        assert!(near(third.point([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]));
    }

    #[test]
    fn a_pivot_stays() {
        let t = Transform::turned([0.0, 1.0, 0.0], 33.0).about([4.0, 5.0, 6.0]);
        assert!(near(t.point([4.0, 5.0, 6.0]), [4.0, 5.0, 6.0]));
    }

    #[test]
    fn normals_stay_square_to_their_planes() {
        let t = Transform::scaled([1.0, 3.0, -2.0]).then(&Transform::turned([1., 2., 3.], 40.0));
        let (u, v) = ([1.0, -1.0, 0.0], [0.0, 1.0, -1.0]);
        let n = t.normal(cross(u, v));
        assert!(dot(n, t.direction(u)).abs() < 1e-12 && dot(n, t.direction(v)).abs() < 1e-12);
        // and on their side
        assert!(dot(n, t.direction(cross(u, v))) > 0.0);
    }

    #[test]
    fn scales() {
        assert_eq!(Transform::scaled([2.0, 2.0, -2.0]).uniform_scale(), Some(2.0));
        let pressed = Transform::scaled([2.0, 1.0, 2.0]);
        assert_eq!(pressed.uniform_scale(), None);
        assert_eq!(pressed.circle_scale([0.0, 3.0, 0.0]), Some(2.0));
        assert_eq!(pressed.circle_scale([1.0, 0.0, 0.0]), None);
        assert!(pressed.keeps_square_to([0.0, 1.0, 0.0]));
        assert!(!pressed.keeps_square_to([1.0, 1.0, 0.0]));
    }
}
