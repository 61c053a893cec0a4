//! What each pattern looks like, as text.

use super::surface::{FLAG, WHITE};
use crate::common::{FromF64, radiance};
use whitted::math::Fixed;
use whitted::scene::{
    Ambient, Material, MaterialSpec, Parts, Pattern, Scene, Texture, TextureSpec, Wrap,
};
use whitted::shape::Plane;

/// A square of 8×4 units of a wall, seen from the front: `@` for 1, ` ` for 0.
fn swatch<A: FromF64>(scene: &Scene<'_, A>) -> String {
    const LEVELS: &[u8; 10] = b" .:-=+*%#@";
    let mut text = String::new();
    for row in 0..10 {
        for column in 0..48 {
            let (x, y) = ((f64::from(column) + 0.5) / 6.0, 4.0 - (f64::from(row) + 0.5) / 2.5);
            let [value, _, _] = radiance(scene, 1, [x, y, 3.0], [0.0, 0.0, -1.0]);
            text.push(char::from(LEVELS[((value * 9.99) as usize).min(9)]));
        }
        text.push('\n');
    }
    text
}

/// The swatches of a texture in the three arithmetics: fixed, single, double.
fn swatches(spec: TextureSpec<'_>) -> [String; 3] {
    macro_rules! one {
        ($a:ty) => {{
            // Not on a border of cells: the wall stands at 0.4.
            swatch::<$a>(&Scene::<$a>::checked(Parts {
                planes: &[Plane::<$a>::new([0.0, 0.0, 1.0], 0.4, 0)],
                materials: &[Material::<$a>::new(MaterialSpec { texture: Some(0), ..WHITE })],
                textures: &[Texture::<$a>::new(spec)],
                ambient: Ambient::<$a>::new([1.0; 3]),
                ..Parts::EMPTY
            }))
        }};
    }
    [one!(Fixed), one!(f32), one!(f64)]
}

/// What is wrong with how a texture looks: nothing, or the pictures that differ.
fn looks(name: &str, spec: TextureSpec<'_>, expected: &str) -> String {
    let expected: String = expected
        .trim_matches([' ', '\n'])
        .lines()
        .map(|line| format!("{}\n", line.trim().trim_matches('|')))
        .collect();
    let mut wrong = String::new();
    for (got, arithmetic) in swatches(spec).iter().zip(["fixed", "f32", "f64"]) {
        let differ = got.chars().zip(expected.chars()).filter(|(a, b)| a != b).count();
        // Rounding may move a value over the border between two levels.
        let allowed = if arithmetic == "fixed" { 0 } else { 8 };
        if differ > allowed || got.len() != expected.len() {
            let framed: String = got.lines().map(|line| format!("        |{line}|\n")).collect();
            wrong += &format!("{name} in {arithmetic} differs in {differ}:\n{framed}");
        }
    }
    wrong
}

const A_CHECKER: &str = "
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |@@@@@@@@@@@@            @@@@@@@@@@@@            |
        |@@@@@@@@@@@@            @@@@@@@@@@@@            |
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |            @@@@@@@@@@@@            @@@@@@@@@@@@|
        |@@@@@@@@@@@@            @@@@@@@@@@@@            |
        |@@@@@@@@@@@@            @@@@@@@@@@@@            |
    ";
const STRIPES: &str = "
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
        |@@@@     @@@@     @@@@     @@@@     @@@@     @@@|
    ";
const A_GRADIENT: &str = "
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
        |@@@@@#####%%%%*****+++++=====-----::::.....     |
    ";
const NOISE: &str = "
        |*+==----=+++++++++++=-:::.:--==+++*%%%*=---::--=|
        |==----::-------=+*%**+=:..:-=+****%%##%++++==--=|
        |=--------------=+***+++=-:.:-+****%#@#*++====+**|
        |---:..::::---=+*%%**+++=:::::-==++******++++==+*|
        |==-:..::--=+++*###%*++++-::::-----+*%%*+=====--=|
        |==--=---=--=+*%###%**++=-:.:=+++++*%%%%+====++++|
        |==++====++==+++*%%*****+=::=+**%#%%%%%*+++++*+++|
        |+***+++++====--=+++++++======++++%#@@#%*****+=--|
        |**%*++++++=-----=++===-=--===++++**#@@#%**++=:..|
        |*%****%%*+==++====+**+===-:..:-=+***%##%*=-::...|
    ";
const MARBLE: &str = "
        |@+.  :%#@#++-. .-:   . :@@- #@%+#@%-=%@@#*%@#..@|
        |%-  *@@@@@#*:   ..     %@@# -@@+=@#++%@@@*+#% -@|
        |   +@%++=.       :%@%  %@%%..@@@++#@#**%#@#-  .+|
        |#- :@@#+=*##%@@##@@@@- +@@@+ *@@#%*=:   .*@#- =@|
        |*+   :#@@@#*=*@@@@##@* +@@%- @%=%@@@@@%*%@@@+ +@|
        |*%%-.  +%+%@@#*=-%@@%: .=#@% %@@@%=-. =@@@@#- +@|
        |@@@@+.  .-*#@@*.      .+#@@+ .:--:.:=+*+-:=@@. -|
        |@%#@%.  .-#@=  .++..:%@@@@*  =%##%%@@%@@+.:%@= .|
        |##%@@+:  .%@=    :==::#@#:   -+*%@@@@@@@@@*#@#: |
        |#*#@@@#%+ -@@%*+   -++--#@:  -@@- .-+#@@@@@@@@:.|
    ";
const WOOD: &str = "
        |.+@@@@@#*=-.              .=%@@@@%:   .=#@@%+:  |
        |#@@@#+:    ..:::-+**+-:.    .-=*@@%-   =#@@@@#- |
        |@@@%-  .-=*##@@@@@@#@@@@#+.    :+@@#+.  -*#@@@%:|
        |@@@+. .+#@@@%*=:.     .=#@%=.    -%@@*:   :=%@@#|
        |@@%: .%@@%-      ....   -#@@*:   :*@@*:   .-*@@@|
        |@@+.  +@@+:     -*%*=:   *@@*:  :*@@%:   .-%@@@#|
        |@@+.  .%@@#+.   .+%%=.  :#@@*:  .=%@@+.  -%@@@#*|
        |@@%=:   .*@@%=.  .::.   =@@#+:  .-+#@@=  *@@@#+.|
        |@@@+:.   .*@@@@#*=-::-*#@@#*=:   :*@@%:  :%@#-  |
        |%@@@*-.   -%##@@@@@@@@@#+:..   :*@@#*-  .=#@@*. |
    ";
const BRICKS: &str = "
        |@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@|
        |@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@|
        |                                                |
        |  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@|
        |                                                |
        |@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@|
        |@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@|
        |                                                |
        |  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@  @@@@@@@@@@|
        |                                                |
    ";
const A_PICTURE: &str = "
        |@@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@        |
        |@@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@        |
        |@@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@        |
        |@@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@        |
        |@@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@        |
        |        @@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@|
        |        @@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@|
        |        @@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@|
        |        @@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@|
        |        @@@@@@@@@@@@@@@@        @@@@@@@@@@@@@@@@|
    ";

#[test]
fn patterns_as_text() {
    let mut wrong = String::new();
    let of = TextureSpec::of;
    let white_first = TextureSpec { size: [2.0, 1.0, 0.0], ..of(Pattern::Checker) };
    wrong += &looks("a checker", white_first, A_CHECKER);
    wrong += &looks(
        "stripes",
        TextureSpec { size: [1.5; 3], ..of(Pattern::Stripes { width: 0.5 }) },
        STRIPES,
    );
    let ramp = Pattern::Gradient { wrap: Wrap::Clamp };
    wrong += &looks("a gradient", TextureSpec { size: [8.0; 3], ..of(ramp) }, A_GRADIENT);
    wrong +=
        &looks("noise", TextureSpec { size: [1.7; 3], ..of(Pattern::Noise { octaves: 3 }) }, NOISE);
    let marble = Pattern::Marble { octaves: 3, turbulence: 1.0 };
    wrong += &looks("marble", TextureSpec { size: [2.0; 3], ..of(marble) }, MARBLE);
    let wood = Pattern::Wood { octaves: 2, turbulence: 0.3 };
    let rings =
        TextureSpec { size: [1.5; 3], origin: [3.0, 1.6, 0.0], up: [0.0, 0.2, 1.0], ..of(wood) };
    wrong += &looks("wood", rings, WOOD);
    let bricks = TextureSpec { size: [2.0, 1.0, 0.0], ..of(Pattern::Brick { mortar: 0.3 }) };
    wrong += &looks("bricks", bricks, BRICKS);
    wrong += &looks(
        "a picture",
        TextureSpec { size: [4.0, 4.0, 0.0], ..of(Pattern::Image(FLAG)) },
        A_PICTURE,
    );
    assert!(wrong.is_empty(), "{wrong}");
}
