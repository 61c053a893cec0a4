//! Which terms of radiance a render adds up, by their names.

use whitted::trace::Terms;

/// The names that a list may have.
pub const NAMES: [(&str, Terms); 10] = [
    ("emission", Terms::EMISSION),
    ("ambient", Terms::AMBIENT),
    ("direct", Terms::DIRECT),
    ("highlight", Terms::HIGHLIGHT),
    ("indirect", Terms::INDIRECT),
    ("background", Terms::BACKGROUND),
    ("reflection", Terms::REFLECTION),
    ("transmission", Terms::TRANSMISSION),
    ("specular", Terms::REFLECTION.with(Terms::TRANSMISSION)),
    ("all", Terms::ALL),
];

/// Whether a set ends any path: mirrors and glass alone show nothing.
pub fn ends(terms: Terms) -> bool {
    terms.without(Terms::REFLECTION).without(Terms::TRANSMISSION) != Terms::NONE
}

/// What is wrong with a set that doesn't.
pub const ENDLESS: &str = "reflection and transmission lead on to other surfaces: name what is to \
                           be seen there too (direct, ambient, emission …)";

/// Reads a list with commas, as in `direct,specular`.
///
/// # Errors
/// A name that isn't known, or a list that shows nothing, in words.
pub fn parse(text: &str) -> Result<Terms, String> {
    let mut terms = Terms::NONE;
    for name in text.split(',') {
        match NAMES.iter().find(|(known, _)| *known == name.trim()) {
            Some((_, term)) => terms = terms.with(*term),
            None => {
                let known: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
                return Err(format!("unknown term {name:?}; known: {}", known.join(", ")));
            }
        }
    }
    if ends(terms) { Ok(terms) } else { Err(ENDLESS.into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_terms() {
        let through = Terms::REFLECTION.with(Terms::TRANSMISSION);
        assert_eq!(parse("direct,specular"), Ok(Terms::DIRECT.with(through)));
        assert_eq!(parse("all"), Ok(Terms::ALL));
        assert!(parse("specular").is_err() && parse("direct,nothing").is_err());
    }
}
