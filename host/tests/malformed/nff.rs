//! NFF that is wrong.

/// The view of an NFF file, in seven lines, and a material in the eighth.
pub(super) const VIEW: &str = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\n\
                    f 1 0 0 1 0 1 0 1\n";

/// Lines that are wrong after `VIEW`, and what the error says.
pub(super) const LINES: &[(&str, &str)] = &[
    ("s 0 0 0", ":9: the file ends where a number (sphere radius) should follow"),
    ("s 0 0 0 x", ":9: found \"x\"; a number (sphere radius) should be here"),
    ("s 0 0 0 NaN", ":9: found \"NaN\"; a finite number (sphere radius)"),
    ("s 0 0 inf 1", ":9: found \"inf\"; a finite number (sphere z)"),
    ("s 0 0 1e400 1", ":9: found \"1e400\"; a finite number"),
    ("s 0 0 0 0", ":9: sphere: its radius is 0"),
    ("s 1e30 0 0 1", ":9: sphere x 1000000000000000000000000000000 is out of range"),
    ("s 0 0 0 1\nq 1", ":10: unknown word \"q\"; known: v, from"),
    ("s 0 0 0 1 5", ":9: unknown word \"5\""),
    ("p 4\n0 0 0\n1 0 0\n1 1 0", ":12: the file ends where a number (polygon corner 4 x)"),
    ("p 3\n0 0 0\n1 0 0\ns 0 0 0 1", ":12: found \"s\"; a number (polygon corner 3 x)"),
    ("p 2\n0 0 0\n1 0 0", ":9: polygon corner count 2 is out of range: it must be 3 to"),
    ("p -3", ":9: polygon corner count -3 is out of range"),
    ("p 3.5", ":9: polygon corner count 3.5 is out of range: it must be a whole number"),
    ("p 999999999", ":9: polygon corner count 999999999 is out of range"),
    ("p 4\n0 0 0\n3 0 0\n0 1 0\n2 1 0", ":9: polygon: its edges cross each other"),
    ("p 3\n0 0 0\n1 1 1\n2 2 2", ": a shape (s, c, p or pp) is missing"),
    ("pp 3\n0 0 0 0 0 1\n1 0 0 0 0", ":11: the file ends where a number (patch normal 2 z)"),
    ("c 0 0 0 1 0 0 0 1", ":9: cylinder: its two ends are one point"),
    ("c 0 0 0 0 0 0 1 0", ":9: cylinder: its radius is 0"),
    ("c 0 0 0 1 0 0 1 -2", ":9: cone: its radii have different signs"),
    ("l 1 2", ":9: the file ends where a number (light z)"),
    ("l 1 2 3 1 1\ns 0 0 0 1", ":10: found \"s\"; a number (light blue)"),
    ("f 1 1 1 -1 0 0 0 1", ":9: Kd -1 is out of range: it must be 0 to 16"),
    ("f 1 1 1 1 0 0 1 0", ":9: ior 0 is out of range: it must be 0.25 to 4 where T is not 0"),
    ("f 1 1 1 1 0 0 2 1", ":9: T 2 is out of range: it must be 0 to 1"),
    ("angle 45", ":9: a second angle; the first is at line 5"),
    ("v", ":9: a second view (v); the first is at line 1"),
    ("", ": a shape (s, c, p or pp) is missing"),
];

/// Whole NFF files.
pub(super) const FILES: &[(&[u8], &str)] = &[
    (b"", ":1: there is no scene in this file; it is empty"),
    (b" \n\t\n", ":1: there is no scene in this file; it is empty"),
    (b"# only a comment\n", ": the view (v, then from, at, up, angle, resolution) is missing"),
    (b"b 1 1 1\ns 0 0 0 1\n", ":2: a material (f r g b Kd Ks Shine T ior) before the first"),
    (b"v\nfrom 0 0 1\nup 0 1 0\nangle 45\n", ":1: the view's target (at x y z) is missing"),
    (b"v\nfrom 0 0 1\nat 0 0 1\nup 0 1 0\nangle 45\n", ":1: view: the camera looks at the point"),
    (b"v\nfrom 0 0 1\nat 0 0 0\nup 0 0 1\nangle 45\n", ":1: view: the camera's up direction lies"),
    (b"v\nfrom 0 0 1\nat 0 0 0\nup 0 0 0\nangle 45\n", ":1: view: the camera's up direction is"),
    (b"v\nangle 180\n", ":2: angle 180 is out of range: it must be 0.01 to 179"),
    (b"v\nresolution 0 5\n", ":2: resolution x 0 is out of range: it must be 1 to 16384"),
    (b"v\nresolution 99999999 5\n", ":2: resolution x 99999999 is out of range"),
    (b"v\nfrom 0 0\xff\xfe 1\n", ":2: is not text"),
    (b"\x7fELF\x02\x01\x01\0\0\0\0\0", ":1: is not text"),
    (b"v\nfrom 0 \0 1\n", ":2: is not text"),
    (b"\x89PNG\r\n\x1a\n", ":1: is not text"),
    (b"once upon a time", ":1: unknown word \"once\"; known: v, from"),
];
