//! Bakes scenes, as a firmware's build script does.

use whitted::math::Fixed;
use whitted_host::build::{blob, source};

fn main() {
    for scene in ["../scenes/showcase.toml", "../scenes/raystones.toml"] {
        blob::<Fixed>(scene, None);
        source::<Fixed>(scene, None);
    }
    // Every kind of shape.
    blob::<f32>("../scenes/shapes.toml", None);
    source::<f32>("../scenes/shapes.toml", None);
}
