//! Scenes that the build script baked.

/// A scene in both of its baked forms.
macro_rules! baked {
    ($(#[$about:meta])* $name:ident, $file:literal) => {
        $(#[$about])*
        pub mod $name {
            include!(concat!(env!("OUT_DIR"), "/", $file, ".rs"));

            /// The same as a blob.
            pub static BLOB: &[u8] =
                whitted::include_blob!(concat!(env!("OUT_DIR"), "/", $file, ".bin"));
        }
    };
}

baked! {
    /// The showcase.
    showcase, "showcase"
}
baked! {
    /// A scene that others know, of hundreds of spheres or of few, as its file says.
    raystones, "raystones"
}
baked! {
    /// Every kind of shape.
    shapes, "shapes"
}
