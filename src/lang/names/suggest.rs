//! Did you mean: the nearest known word, and words of other languages.

/// Words that begin a declaration and are no names.
pub(in crate::lang) const RESERVED: &[&str] = &[
    "library", "task", "feature", "rule", "class", "classes", "layout", "scene", "test", "study", "use", "let",
];

const FOREIGN: &[(&str, &str)] = &[
    ("degree", "deg"),
    ("degrees", "deg"),
    ("°", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("millimeter", "mm"),
    ("millimeters", "mm"),
    ("millimetre", "mm"),
    ("millimetres", "mm"),
    ("centimeter", "cm"),
    ("centimeters", "cm"),
    ("centimetre", "cm"),
    ("centimetres", "cm"),
    ("inch", "in"),
    ("inches", "in"),
    ("percent", "%"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("millisecond", "ms"),
    ("milliseconds", "ms"),
    ("view", "views"),
    ("voxel", "voxels"),
    ("color", "colour"),
    ("center", "centre"),
    ("import", "use"),
    ("include", "use"),
    ("from", "use"),
    ("def", "let"),
    ("define", "let"),
    ("const", "let"),
    ("var", "let"),
    ("fn", "let"),
    ("function", "let"),
    ("proof", "detect"),
    ("cal", "measure"),
    ("calibrate", "measure"),
    ("pred", "predict"),
    ("assert", "expect"),
    ("check", "expect"),
    ("then", "expect"),
    ("when", "given"),
    ("suppose", "given"),
    ("fact", "test"),
    ("suite", "study"),
    ("experiment", "study"),
    ("benchmark", "study"),
    ("sensor", "camera"),
    ("viewpoints", "views"),
    ("resolution", "voxel"),
    ("foreach", "for"),
    ("rotated", "turned"),
    ("background", "backdrop"),
    ("or", "else"),
    ("elif", "else"),
    ("plane", "polygon"),
    ("face", "polygon"),
    ("distance", "length"),
    ("string", "text"),
    ("int", "count"),
    ("integer", "count"),
    ("float", "number"),
    ("qr", "marker"),
    ("qr_code", "marker"),
    ("qrcode", "marker"),
    ("tag", "marker"),
    ("fiducial", "marker"),
];

/// What a word of another language or habit is called here.
pub(in crate::lang) fn foreign(word: &str) -> Option<&'static str> {
    let lower = word.to_ascii_lowercase();
    FOREIGN
        .iter()
        .find(|(theirs, _)| *theirs == lower)
        .map(|(_, ours)| *ours)
}

/// The candidate that `word` is most likely a slip for.
///
/// Damerau–Levenshtein distance up to a third of the length; ties go to the
/// candidate that sorts first.
pub(crate) fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let foreign = foreign(word);
    let most = (word.chars().count() / 3).clamp(1, 4);
    candidates
        .into_iter()
        .filter(|c| *c != word)
        .map(|c| {
            let same = c.eq_ignore_ascii_case(word) || foreign == Some(c);
            (if same { 0 } else { distance(word, c, most) }, c)
        })
        .filter(|(d, c)| *d <= most && *d < c.chars().count())
        .min()
        .map(|(_, c)| c)
}

/// `a, b or c` in backticks, cut short where it is long.
pub(in crate::lang) fn one_of<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    const MOST: usize = 14;
    let words: Vec<String> = words.into_iter().map(|w| format!("`{w}`")).collect();
    match words.as_slice() {
        [] => "nothing".into(),
        [one] => one.clone(),
        all if all.len() > MOST => format!("{} and {} more", all[..MOST].join(", "), all.len() - MOST),
        [init @ .., last] => format!("{} or {last}", init.join(", ")),
    }
}

/// Distance with insertions, deletions, substitutions and swaps of neighbours; more
/// than `most` as soon as it is known to be.
fn distance(a: &str, b: &str, most: usize) -> usize {
    if a.len().abs_diff(b.len()) > 4 * most {
        return most + 1;
    }
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(64).collect(), b.chars().take(64).collect());
    if a.len().abs_diff(b.len()) > most {
        return most + 1;
    }
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        // A swap reaches back two rows: both must be beyond hope.
        if row.iter().chain(&last).all(|d| *d > most) {
            return most + 1;
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_by_hand() {
        assert_eq!(distance("goal", "gaol", 4), 1);
        assert_eq!(distance("sphere", "sphere", 4), 0);
        assert_eq!(distance("bottom", "buttons", 4), 3);
        assert_eq!(distance("", "abc", 4), 3);
    }

    #[test]
    fn only_near_words_are_suggested() {
        let known = ["bottom", "prism_side", "deg"];
        assert_eq!(closest("botom", known), Some("bottom"));
        assert_eq!(closest("degrees", known), Some("deg"));
        assert_eq!(closest("apex", known), None);
        assert_eq!(closest("x", ["y", "mm"]), None);
    }
}
