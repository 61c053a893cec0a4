//! The octree: a cube cut in eight, again and again (Glassner 1984; the walk after Revelles,
//! Ureña and Lastra 2000 and Laine and Karras 2010).

mod extent;

pub use extent::Extent;
