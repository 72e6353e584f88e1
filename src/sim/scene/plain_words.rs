//! Messages of the parser in the terms of scene files.

/// Remedies of missing keys, by the words of their message.
const REMEDIES: [(&str, &str); 3] = [
    ("`grid`", "; accuracy = \"2 %\" in [grid] chooses box and cells"),
    (
        "missing key `roelands_z`",
        "; an oil is also given by its data sheet (grade and viscosity_index, or kinematic), or as isoviscous: viscosity = { law = \"barus\", \
         eta0 = \"18 mPa s\", alpha = 0 }",
    ),
    (
        "missing key `exposure`",
        "; exposure = \"track\": a point of the track wears while the contact passes, once a round, for coefficients by \
         load and sliding distance (needs track.radius_ball and track.radius_disc of bodies that move); \
         exposure = \"contact_clock\": a point wears as if it never left the contact, for coefficients fitted to the depth \
         at the time of a test",
    ),
];

/// Terms of the parser and their replacements for readers of scene files.
const WORDS: [(&str, &str); 28] = [
    ("expected f64", "expected a number"),
    ("expected usize", "expected a whole number from 0"),
    ("expected u64", "expected a whole number from 0"),
    ("expected a boolean", "expected true or false"),
    ("expected a sequence", "expected a list"),
    ("expected path string", "expected text"),
    ("expected a string", "expected text"),
    ("wanted string or table", "expected text"),
    ("invalid type: sequence", "a list"),
    ("invalid type: boolean ", ""),
    ("invalid type: string", "text"),
    ("invalid type: map", "a table"),
    ("expected an array of length 2", "expected a list of two numbers"),
    ("elements in sequence", "values"),
    ("floating point", "number"),
    ("invalid type: integer", "whole number"),
    ("invalid value: integer", "whole number"),
    ("invalid type: ", ""),
    ("invalid value: ", ""),
    ("invalid length ", "length "),
    ("number too large to fit in target type", "the number is too large"),
    ("u64 value was too large", "the number is too large"),
    ("invalid digit found in string", "not a whole number"),
    ("unknown variant", "unknown value"),
    ("unknown field", "unknown key"),
    ("missing field", "missing key"),
    ("there are no fields", "there are no other keys"),
    ("expected variant identifier", "expected text"),
];

/// The message in the terms of scene files, without type names of this crate.
pub(super) fn of(message: &str) -> String {
    let plain = WORDS.iter().fold(message.to_owned(), |text, (from, to)| text.replace(from, to));
    let named = ["expected struct ", "expected internally tagged enum "];
    match named.iter().find_map(|kind| plain.split_once(kind)) {
        None => plain,
        Some((before, after)) => {
            let rest = after.split_once(' ').map_or(String::new(), |(_, rest)| format!(" {rest}"));
            format!("{before}expected a table{rest}")
        }
    }
}

/// The message of a missing key with its remedy.
pub(super) fn with_remedy(message: String) -> String {
    let is_missing = message.contains("missing key");
    let remedy = REMEDIES.iter().find(|(words, _)| is_missing && message.contains(words));
    message + remedy.map_or("", |(_, remedy)| remedy)
}
