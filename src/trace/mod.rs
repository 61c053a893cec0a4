//! Tracing: from a camera's ray to its radiance, the tree of rays on an explicit stack.

mod area;
pub(crate) mod call_site;
mod detail;
mod direct;
mod indirect;
mod meet;
mod nearest;
mod probe;
mod radiance;
mod select;
mod sight;
mod site;
mod terms;
mod tracer;
mod visible;
mod work;

pub(crate) use area::point_of_light;
pub use nearest::Hit;
pub(crate) use sight::FEW;
pub use terms::{Paths, Terms};
pub use tracer::Tracer;
pub use work::Work;
