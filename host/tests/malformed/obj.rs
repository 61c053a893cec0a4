//! OBJ that is wrong.

/// Lines that are wrong after three positions, in OBJ.
pub(super) const LINES: &[(&str, &str)] = &[
    ("v 1 2", ":4: a number or name (position z) on this line is missing"),
    ("v 1 2 x", ":4: found \"x\"; a number (position z)"),
    ("v 1 2 nan", ":4: found \"nan\"; a finite number (position z)"),
    ("v 1 2 1e9", ":4: position z 1000000000 is out of range"),
    ("f 1 2", ":4: number of corners 2 is out of range: it must be 3 or more"),
    ("f 1 2 4", ":4: position number 4 is out of range: it must be 1 to 3, or -1 to -3"),
    ("f 1 2 0", ":4: position number 0 is out of range: it must be 1 to 3"),
    ("f 1 2 -4", ":4: position number -4 is out of range"),
    ("f 1 2 99999999999999999999", ":4: found \"99999999999999999999\"; position/texture/normal"),
    ("f 1 2 3/1", ":4: texture coordinate number 1 is out of range: it must be left out: no"),
    ("f 1 2 3//1", ":4: normal number 1 is out of range: it must be left out"),
    ("f 1 2 //3", ":4: normal number 3 is out of range"),
    ("vt x", ":4: found \"x\"; a number (texture u)"),
    ("vt 0 2e6", ":4: texture v 2000000 is out of range: it must be -1000000 to 1000000"),
    ("f 1 2 x", ":4: found \"x\"; position/texture/normal, each a whole number"),
    ("s red", ":4: found \"red\"; a smoothing group's number, or off"),
    ("usemtl", ":4: a number or name (material) on this line is missing"),
    ("solid teapot", ":4: unknown word \"solid\"; known: v, vt, vn, f"),
    ("f 1 1 1", ": a face (f) with an area is missing"),
    ("", ": a face (f) with an area is missing"),
];
