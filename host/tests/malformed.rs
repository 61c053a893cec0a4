//! Scenes that are wrong: each a clear error with file and line, exit code 2, no output.

mod common;

use std::fmt::Write as _;

use common::{errors, files, whitted};

/// A whole scene in TOML, to which a case adds something wrong; six lines.
const GOOD: &str = "[camera]\neye = [0, 1, -5]\nlook_at = [0, 0, 0]\n\
                    [[material]]\nname = \"red\"\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";

/// The view of an NFF file, in seven lines, and a material in the eighth.
const VIEW: &str = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\n\
                    f 1 0 0 1 0 1 0 1\n";

/// Lines that are wrong after `VIEW`, and what the error says.
const NFF: &[(&str, &str)] = &[
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
const NFF_FILES: &[(&[u8], &str)] = &[
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

/// Lines that are wrong after `GOOD`, and what the error says.
const TOML: &[(&str, &str)] = &[
    ("[indirect]", ":9: key \"type\" of this indirect is missing"),
    (
        "[indirect]\ntype = \"photons\"",
        ":10: unknown word \"photons\"; known: cache, virtual-lights",
    ),
    ("[indirect]\ntype = \"cache\"\nerror = 2", ":11: error 2 is out of range: it must be 0.05"),
    ("[indirect]\ntype = \"cache\"\nrays = 0", ":11: rays 0 is out of range: it must be 1 to"),
    ("[indirect]\ntype = \"cache\"\nlights = 4", ":11: unknown key \"lights\"; known: type, error"),
    (
        "[indirect]\ntype = \"cache\"\nnearest = 2\nfarthest = 1",
        ":9: indirect: \"nearest\" is larger than \"farthest\"",
    ),
    (
        "[indirect]\ntype = \"virtual-lights\"\ntile = 3",
        ":11: tile 3 is out of range: it must be 1, 2 or 4",
    ),
    (
        "[indirect]\ntype = \"virtual-lights\"\nbounces = 5",
        ":11: bounces 5 is out of range: it must be 1 to 4",
    ),
    ("radius = 2", ":9: duplicate key"),
    ("colour = 1", ":9: unknown key \"colour\"; known: material, center, radius"),
    ("[[sphere]]\ncenter = [0, 0, 0]", ":9: key \"radius\" of this sphere is missing"),
    ("[[solid]]", ":9: \"union\", \"intersection\" or \"difference\" of this solid is missing"),
    ("[[solid]]\nunion = []", ":10: found an empty list for \"union\"; a part or more"),
    ("[[solid]]\nunion = 1", ":10: found 1 for \"union\"; a list of parts"),
    ("[[solid]]\nunion = [{ }]", ":10: shape (sphere, box, cylinder, cone, plane, union"),
    ("[[solid]]\nunion = [{ disc = 1 }]", ":10: shape (sphere, box, cylinder, cone, plane, union"),
    ("[[solid]]\nunion = [{ sphere = { radius = 1 } }]", ":10: key \"center\" of this sphere"),
    (
        "[[solid]]\nunion = [{ sphere = { center = [0, 0, 0], radius = 1, caps = 1 } }]",
        ":10: unknown key \"caps\"",
    ),
    (
        "[[solid]]\nunion = [{ box = { min = [0, 0, 0], max = [0, 1, 1] } }]",
        ":10: box: its min must lie below its max",
    ),
    (
        "[[solid]]\nunion = [{ plane = { point = [0, 0, 0], normal = [0, 1, 0] } }]",
        ":9: solid: it has no end: a shape that ends must hold it together",
    ),
    (
        "[[solid]]\nunion = [{ sphere = { center = [0, 0, 0], radius = 1 } }]\nintersection = []",
        ":11: intersection: it stands beside another way to combine",
    ),
    (
        "[[solid]]\nunion = [{ sphere = { center = [0, 0, 0], radius = 1 }, material = \"x\" }]",
        ":10: unknown material \"x\"; known: red",
    ),
    (
        "[[solid]]\nrotate = [0, 45, 0]\nunion = [{ box = { min = [0, 0, 0], max = [1, 1, 1] } }]",
        ":9: solid: a box within a solid stays along the axes",
    ),
    (
        "[[solid]]\nintersection = [{ sphere = { center = [0, 0, 0], radius = 1 } }, \
         { sphere = { center = [9, 0, 0], radius = 1 } }]",
        ":9: solid can't be represented: a solid needs one to eight operands, an inside",
    ),
    ("[[cylinder]]\nbase = [0, 0, 0]\napex = [0, 1, 0]\nradius = 1\ncaps = 1", ":13: found 1 for"),
    ("[[group]]\nname = \"g\"", ":9: a shape ([[group.sphere]], …) of this group is missing"),
    ("[[group]]\n[[group.disc]]", ":9: key \"name\" of this group is missing"),
    ("[[group]]\nname = \"g\"\nsphere = 1", ":11: found 1 for \"sphere\"; a list of tables"),
    ("[[group]]\nname = \"g\"\nfoo = 1", ":11: unknown key \"foo\"; known: name, sphere"),
    (
        "[[group]]\nname = \"g\"\n[[group.plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]",
        ":11: plane: it has no end, and a group must have one",
    ),
    ("[[instance]]\ngroup = \"h\"", ":10: unknown group \"h\""),
    ("[[instance]]\nmove = [0, 0, 0]", ":9: key \"group\" of this instance is missing"),
    ("[[sphere]]\ncenter = [0, 0]\nradius = 1", ":10: found a list of 2 for \"center\"; [x, y, z]"),
    ("[[sphere]]\ncenter = [0, 0, 0]\nradius = -1", ":11: radius -1 is out of range: it must be"),
    ("[[sphere]]\ncenter = [0, nan, 0]\nradius = 1", ":10: found nan for \"center\"; a finite"),
    ("[[sphere]]\ncenter = [0, inf, 0]\nradius = 1", ":10: found inf for \"center\"; a finite"),
    ("[[sphere]]\ncenter = [0, 1e9, 0]\nradius = 1", ":10: center 1000000000 is out of range"),
    ("[[sphere]]\ncenter = 5\nradius = 1", ":10: found 5 for \"center\"; [x, y, z] should be"),
    ("[[sphere]]\nmaterial = \"blue\"", ":10: unknown material \"blue\"; known: red"),
    ("[[sphere]]\nmaterial = 3", ":10: found 3 for \"material\"; a text in quotes"),
    ("[sphere]\nradius = 1", ":9: duplicate key"),
    ("[[torus]]\nradius = 1", ":9: unknown key \"torus\"; known: camera, render"),
    ("[[material]]\nname = \"red\"", ":10: a second material \"red\"; the first is at line 4"),
    ("[[material]]\ndiffuse = 1", ":9: key \"name\" of this material is missing"),
    ("[[material]]\nname = \"a\"\ndiffuse = -0.5", ":11: diffuse -0.5 is out of range"),
    ("[[material]]\nname = \"a\"\nreflection = 1.5", ":11: reflection 1.5 is out of range: it"),
    ("[[material]]\nname = \"a\"\ndiffuse = \"#12345g\"", ":11: found \"#12345g\" for \"diffuse\""),
    ("[[material]]\nname = \"a\"\nindex = 0", ":11: index 0 is out of range: it must be 0.25"),
    ("[[material]]\nname = \"a\"\nshadow = \"soft\"", ":11: unknown word \"soft\"; known: opaque"),
    ("[[material]]\nname = \"a\"\nchecker = { size = 1 }", ":11: key \"with\" of this checker"),
    ("[[material]]\nname = \"a\"\nchecker = { with = \"b\" }", ":11: unknown material \"b\""),
    ("[[material]]\nname = \"a\"\nchecker = { with = \"a\" }", ":9: checker: its two materials"),
    ("[[material]]\nname = \"a\"\nchecker = { with = \"red\", size = 0 }", ":11: size 0 is out"),
    ("[[material]]\nname = \"a\"\ntexture = 3", ":11: found 3 for \"texture\"; a table should"),
    ("[[material]]\nname = \"a\"\ntexture = { size = 1 }", ":11: key \"type\" of this texture"),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"fur\" }",
        ":11: unknown word \"fur\"; known",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", width = 1 }",
        ":11: unknown key \"width\"",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", octaves = 9 }",
        ":11: octaves 9 is out of range: it must be 1 to 8",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", size = 0 }",
        ":11: size 0 is out of range",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", size = [0, -1, 0] }",
        ":11: texture: its size must be positive",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", colors = [1] }",
        ":11: found a list of 1 for \"colors\"; two colors should be here",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", with = \"b\" }",
        ":11: unknown material \"b\"; known: red, a",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", with = \"a\" }",
        ":11: texture: its two materials are the same",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", with = \"red\", colors = [0, 1] }",
        ":11: colors of a texture: \"with\" says",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", with = \"red\", mapping = \"uv\" }",
        ":11: texture: another material can't be shown by a mesh's",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"noise\", right = [0, 2, 0] }",
        ":11: texture: a direction is null or not a number",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"image\" }",
        ":11: key \"file\" of this texture is missing",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"image\", file = \"no.png\" }",
        ":11: picture \"no.png\": can't be read: No such file",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"image\", file = \"bad.toml\" }",
        ":11: picture \"bad.toml\": is no picture in PNG",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"image\", file = \".\" }",
        ":11: picture \".\": is a directory",
    ),
    (
        "[[material]]\nname = \"a\"\ntexture = { type = \"image\", file = \"x\", palette = 2 }",
        ":11: palette 2 is out of range: it must be 16 to 256",
    ),
    ("[[material]]\nname = \"a\"\nbump = { type = \"noise\" }", ":11: key \"height\" of this bump"),
    (
        "[[material]]\nname = \"a\"\nbump = { type = \"noise\", height = 5 }",
        ":11: height 5 is out of range: it must be within ±4, four cells",
    ),
    (
        "[[material]]\nname = \"a\"\nbump = { type = \"noise\", height = 1, mapping = \"spherical\" }",
        ":11: bump: only a planar mapping has slopes",
    ),
    ("[[material]]\nname = \"a\"\nfresnel = 1", ":11: found 1 for \"fresnel\"; true or false"),
    ("[[material]]\nname = \"a\"\nabsorption = -1", ":11: absorption -1 is out of range: it must"),
    (
        "[[material]]\nname = \"a\"\nabsorption = [1, 2]",
        ":11: found a list of 2 for \"absorption\"",
    ),
    (
        "[[triangle]]\ncorners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nuv = [[0, 0], [1, 0]]",
        ":11: found a list of 2 for \"uv\"; a list of three [u, v]",
    ),
    (
        "[[triangle]]\ncorners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nuv = [[0, 0], [1, 0], [0, 9]]",
        ":11: uv 9 is out of range",
    ),
    ("[[triangle]]\ncorners = [[0, 0, 0], [1, 1, 1], [2, 2, 2]]", ":9: triangle: its corners lie"),
    ("[[triangle]]\ncorners = [[0, 0, 0], [1, 1, 1]]", ":10: found a list of 2 for \"corners\""),
    (
        "[[polygon]]\ncorners = [[0, 0, 0], [3, 0, 0], [0, 1, 0], [2, 1, 0]]",
        ":9: polygon: its edges",
    ),
    ("[[polygon]]\ncorners = []", ":10: found a list of 0 for \"corners\"; three points or more"),
    ("[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]", ":11: normal: 0 0 0 is no direction"),
    ("[[box]]\nmin = [0, 0, 0]\nmax = [1, 0, 1]", ":9: box: its min must lie below its max"),
    ("[[disc]]\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nradius = 0", ":12: radius 0 is out of"),
    ("[[cone]]\nbase = [0, 0, 0]\nbase_radius = 1\napex = [0, 0, 0]", ":9: cone: its two ends"),
    (
        "[[light]]\ntype = \"area\"\nposition = [0, 0, 0]",
        ":10: unknown word \"area\"; known: point",
    ),
    ("[[light]]\ntype = \"rectangle\"", ":9: key \"radiance\" of this light is missing"),
    ("[[light]]\ntype = \"disc\"\nradiance = -1", ":11: radiance -1 is out of range"),
    ("[[light]]\ntype = \"disc\"\nradiance = 2000\nvisible = true", ":11: radiance 2000 is out"),
    (
        "[[light]]\ntype = \"sphere\"\nradiance = 1\ncenter = [0, 0, 0]\nradius = 0",
        ":13: radius 0 is",
    ),
    ("[[light]]\ntype = \"sphere\"\nradiance = 1\nerror = 0", ":12: error 0 is out of range"),
    ("[[light]]\ntype = \"sphere\"\nradiance = 1\nsamples = 5", ":12: found 5 for \"samples\""),
    (
        "[[light]]\ntype = \"sphere\"\nradiance = 1\nsamples = [5, 4]",
        ":12: samples 4 is out of range",
    ),
    ("[[light]]\ntype = \"sphere\"\nradiance = 1\nsamples = [5, 2000]", ":12: samples 2000 is out"),
    (
        "[[light]]\ntype = \"rectangle\"\nradiance = 1\ncorner = [0, 0, 0]\nedges = [[1, 0, 0]]",
        ":13: found a list of 1 for \"edges\"; a list of two edges",
    ),
    (
        "[[light]]\ntype = \"rectangle\"\nradiance = 1\ncorner = [0, 0, 0]\n\
         edges = [[1, 0, 0], [2, 0, 0]]",
        ":9: rectangle light: its corners lie on a line",
    ),
    (
        "[[light]]\ntype = \"triangle\"\nradiance = 1\ncorners = [[0, 0, 0], [1, 1, 1], [2, 2, 2]]",
        ":9: triangle light: its corners lie on a line",
    ),
    (
        "[[light]]\ntype = \"polygon\"\nradiance = 1\n\
         corners = [[0, 0, 0], [2, 0, 0], [0.5, 0.5, 0], [0, 2, 0]]",
        ":9: polygon light: it is concave",
    ),
    ("[[light]]\ntype = \"sphere\"\nradiance = 1\nposition = [0, 0, 0]", ":9: key \"center\" of"),
    ("[render]\nlights = \"some\"", ":10: unknown word \"some\"; known: all"),
    ("[render]\nlights = { choose = 0 }", ":10: choose 0 is out of range: it must be 1 to 255"),
    ("[render]\nlights = { threshold = -1 }", ":10: threshold -1 is out of range"),
    ("[render]\nlights = {}", ":10: either \"threshold\" or \"choose\" of this lights is missing"),
    ("[render]\nlights = { chose = 1 }", ":10: unknown key \"chose\"; known: threshold, choose"),
    ("[render]\nterms = [\"direct\", \"gloss\"]", ":10: unknown word \"gloss\"; known: emission"),
    ("[render]\nterms = [\"specular\"]", ":10: terms: reflection and transmission lead on"),
    ("[render]\nterms = \"direct\"", ":10: found \"direct\" for \"terms\"; a list of words"),
    ("[render]\nseed = 70000", ":10: seed 70000 is out of range: it must be 0 to 65535"),
    ("[render]\nlight_jitter = 1", ":10: found 1 for \"light_jitter\"; true or false"),
    ("[[material]]\nname = \"a\"\nemission = 2000", ":11: emission 2000 is out of range"),
    ("[[light]]\nintensity = 3", ":9: key \"position\" of this light is missing"),
    ("[[light]]\nposition = [0, 0, 0]\ndirection = [0, 0, 1]", ":11: unknown key \"direction\""),
    ("[[light]]\ntype = \"spot\"\nposition = [0, 1, 0]\nlook_at = [0, 1, 0]", ":9: spot light: it"),
    (
        "[[light]]\ntype = \"spot\"\nposition = [0, 1, 0]\nlook_at = [0, 0, 0]\ninner = 40\nouter = 30",
        ":13: inner 40 is out of range: it must be smaller than \"outer\", 30",
    ),
    ("[render]\nsize = [0, 10]", ":10: width 0 is out of range: it must be 1 to 16384"),
    ("[render]\nsize = [1000000, 1000000]", ":10: width 1000000 is out of range"),
    ("[render]\nsize = 100", ":10: found 100 for \"size\"; [width, height] should be here"),
    ("[render]\ndepth = 0", ":10: depth 0 is out of range: it must be 1 to 64"),
    ("[render]\ndepth = 2.5", ":10: depth 2.5 is out of range: it must be a whole number"),
    ("[render]\nsampling = 4", ":10: found 4 for \"sampling\"; a text in quotes should be here"),
    (
        "[render]\nsampling = \"fine\"",
        ":10: sampling: \"fine\" isn't a sampling: it is center, cor",
    ),
    (
        "[render]\nsampling = \"grid:9\"",
        ":10: sampling: \"9\" isn't a number of cells each way, 1 to 8",
    ),
    ("[render]\nspecular_cosine = 1", ":10: found 1 for \"specular_cosine\"; true or false"),
    ("[background]\nbottom = 1", ":9: either \"color\", or both \"bottom\" and \"top\""),
    ("[camera]\neye = [0, 0, 0]", ":9: duplicate key"),
    ("scale = 0", ":9: scale 0 is out of range: it must be larger than 0, or negative"),
    ("scale = [1, 2, 1]", ":6: sphere: it can't be scaled unevenly: a ball stays a ball"),
    ("rotate = 30", ":9: found 30 for \"rotate\"; [x, y, z] in degrees, or { axis"),
    ("rotate = { axis = [0, 0, 0], angle = 3 }", ":9: axis: 0 0 0 is no direction"),
    ("rotate = { axis = [0, 1, 0] }", ":9: key \"angle\" of this rotate is missing"),
    ("move = [1, 2]", ":9: found a list of 2 for \"move\"; [x, y, z] should be"),
    ("move = [1, 2, 3]\ntranslate = [1, 2, 3]", ":10: translate: it stands beside \"move\""),
    (
        "scale = 1e8\nrepeat = { count = 3, step = [1e8, 0, 0] }",
        ":6: placed coordinate 300000000 is out of range: it must be within",
    ),
    ("repeat = 3", ":9: found 3 for \"repeat\"; a table { count = …, step = [x, y, z] }"),
    ("repeat = { count = 0, step = [1, 0, 0] }", ":9: count 0 is out of range: it must be 1"),
    ("repeat = { count = 2 }", ":9: \"step\" or \"rotate\" of this repeat is missing"),
    ("repeat = { step = [1, 0, 0] }", ":9: key \"count\" of this repeat is missing"),
    ("repeat = []", ":9: number of directions 0 is out of range: it must be 1 to 3"),
    (
        "repeat = [{ count = 2000, step = [1, 0, 0] }, { count = 2000, step = [0, 1, 0] }]",
        ":9: number of copies 4000000 is out of range: it must be at most 1000000",
    ),
    (
        "[[cylinder]]\nbase = [0, 0, 0]\napex = [1, 1, 0]\nradius = 1\nscale = [1, 2, 1]",
        ":9: cylinder: it can't be scaled unevenly at a slant to its axis",
    ),
    ("[[include]]\nfile = \"nowhere.toml\"", ":10: nowhere.toml: can't be read: No such file"),
    ("[[include]]\nfile = \"x.stl\"", ":10: x.stl: can't be read"),
    ("[[include]]\nfile = \"bad.toml\"", ":10: include \"bad.toml\": this file is within that"),
    ("[[include]]\nscale = 3", ":9: key \"file\" of this include is missing"),
    ("[[include]]\nfile = 3", ":10: found 3 for \"file\"; a text in quotes"),
    ("[[mesh]]\nfile = \"no.obj\"", ":10: no.obj: can't be read: No such file"),
    ("[[mesh]]\nmaterial = \"red\"", ":9: key \"file\" of this mesh is missing"),
    ("mesh = \"a.obj\"", ":9: unknown key \"mesh\"; known: material, center"),
    ("x = [", ":9: unclosed array"),
    ("x = \"abc", ":9: invalid basic string"),
];

/// Whole TOML files.
const TOML_FILES: &[(&[u8], &str)] = &[
    (b"", ":1: there is no scene in this file; it is empty"),
    (b"[render]\n", ": the camera ([camera] eye, look_at) is missing"),
    (b"camera = 3\n", ":1: found 3 for \"camera\"; a table should be here"),
    (b"[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n", ": a shape ([[sphere]], [[plane]]"),
    (b"[camera]\nlook_at = [0, 0, 0]\n", ":1: key \"eye\" of this camera is missing"),
    (b"[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 0]\n", ":1: camera: the camera looks at the"),
    (b"[camera]\neye = [0, 1, 0]\nlook_at = [0, 0, 0]\n", ":1: camera: the camera's up direction"),
    (b"[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\nangle = 180\n", ":4: angle 180 is out of"),
    (b"[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\nangle_spans = \"all\"\n", ":4: unknown word"),
    (b"[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n",
     ":4: key \"material\" of this sphere is missing"),
    (b"[camera\n", ":1: "),
    (b"\x00\x01\x02\xff", ":1: is not text"),
    (b"[camera]\neye = \"\xc3\x28\"\n", ":2: is not text"),
];

/// Lines that are wrong after three positions, in OBJ.
const OBJ: &[(&str, &str)] = &[
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

/// Every case as a file: its name, its bytes, what the error says.
fn cases() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let after = |start: &str, rest: &str| format!("{start}{rest}\n").into_bytes();
    let mut all = Vec::new();
    all.extend(NFF.iter().map(|(text, says)| ("bad.nff", after(VIEW, text), *says)));
    all.extend(NFF_FILES.iter().map(|(bytes, says)| ("bad.nff", bytes.to_vec(), *says)));
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    all.extend(OBJ.iter().map(|(text, says)| ("bad.obj", after(three, text), *says)));
    all.extend(TOML.iter().map(|(text, says)| ("bad.toml", after(GOOD, text), *says)));
    all.extend(TOML_FILES.iter().map(|(bytes, says)| ("bad.toml", bytes.to_vec(), *says)));
    all
}

#[test]
fn each_is_a_clear_error_and_leaves_no_file() {
    let cases = cases();
    assert!(cases.len() >= 40);
    let mut wrong = String::new();
    for (name, bytes, says) in cases {
        let place = tempfile::tempdir().unwrap();
        std::fs::write(place.path().join(name), &bytes).unwrap();
        let output = whitted(place.path(), &["render", name, "--size", "8x8", "-o", "out.png"]);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let error = errors(&output);
        let wanted = format!("{name}{says}");
        if !error.contains(&wanted) {
            let _ = write!(wrong, "{text}\nsays: {error}not: {wanted}\n\n");
        }
        assert_eq!(
            error.trim_end().lines().last().map(|l| l.contains(name)),
            Some(true),
            "{error}"
        );
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(output.stdout.is_empty());
        assert_eq!(files(place.path()), [name]);
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_good_parts_are_good() {
    let place = tempfile::tempdir().unwrap();
    std::fs::write(place.path().join("good.toml"), GOOD).unwrap();
    std::fs::write(place.path().join("good.nff"), format!("{VIEW}s 0 0 0 1\n")).unwrap();
    for scene in ["good.toml", "good.nff"] {
        let output = whitted(place.path(), &["check", scene]);
        assert_eq!(errors(&output), "");
        assert_eq!(output.status.code(), Some(0));
    }
}

#[test]
fn what_is_no_scene_file() {
    let place = tempfile::tempdir().unwrap();
    std::fs::create_dir(place.path().join("folder.toml")).unwrap();
    std::fs::write(place.path().join("scene.stl"), "solid").unwrap();
    std::fs::write(place.path().join("scene"), "solid").unwrap();
    for (scene, says) in [
        ("nowhere.toml", "nowhere.toml: can't be read: No such file"),
        ("folder.toml", "folder.toml: is a directory; a scene is a file"),
        ("scene.stl", "scene.stl: unknown format \"stl\"; known: .toml, .nff, .obj, .gltf"),
        ("scene", "scene: unknown format \"\"; known: .toml, .nff, .obj, .gltf"),
    ] {
        let output = whitted(place.path(), &["render", scene]);
        assert!(errors(&output).contains(says), "{}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
    assert_eq!(files(place.path()), ["folder.toml", "scene", "scene.stl"]);
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("secret.toml");
    std::fs::write(&file, GOOD).unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o000)).unwrap();
    if std::fs::read(&file).is_ok() {
        eprintln!("skipped: this user may read everything");
        return;
    }
    let output = whitted(place.path(), &["render", "secret.toml"]);
    assert!(errors(&output).contains("secret.toml: can't be read: Permission denied"));
    assert_eq!(output.status.code(), Some(2));
}
