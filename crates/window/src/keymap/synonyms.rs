//! Synonyms for the search: searching for one word also finds rows with the others.

/// Each row is one meaning. Words of several parts are found in descriptions as they stand.
const SYNONYMS: [&[&str]; 20] = [
    &["orbit", "rotate", "turn", "spin", "tumble", "look around"],
    &["pan", "move", "shift", "translate", "slide"],
    &["zoom", "magnify", "closer", "dolly", "scale"],
    &["screenshot", "save", "export", "image", "capture", "snapshot"],
    &["open", "import", "browse", "load"],
    &["load the file again", "reload", "refresh", "revert"],
    &["quit", "exit", "close the window"],
    &["this list", "help", "shortcuts", "hotkeys", "bindings", "cheat sheet"],
    &["edges", "lines", "polygons", "mesh"],
    &["wireframe", "lines", "x-ray"],
    &["samples", "anti-aliasing", "antialiasing", "smooth", "msaa"],
    &["frame time", "fps", "speed", "performance"],
    &["counts", "statistics", "information", "metadata", "dimensions", "size of the model"],
    &["accuracy", "quality", "preset", "settings"],
    &["reset the view", "home", "fit", "frame all", "center"],
    &["perspective / orthographic", "projection", "parallel", "ortho"],
    &["full screen", "fullscreen", "maximise", "maximize"],
    &["undo", "back", "revert"],
    &["light", "brightness", "exposure", "darker"],
    &["play", "animation", "pause", "stop"],
];

/// Whether every word of a search, in lower case, or a synonym of it is in a text in lower case.
#[must_use]
pub fn matches_search(text: &str, search: &str) -> bool {
    search.split_whitespace().all(|word| text.contains(word) || by_synonym(text, word))
}

fn by_synonym(text: &str, word: &str) -> bool {
    /// Beginnings that are shorter would find nearly everything.
    const SHORTEST: usize = 3;
    let is_meant = |meaning: &&&[&str]| meaning.iter().any(|known| known.starts_with(word));
    word.len() >= SHORTEST
        && SYNONYMS.iter().filter(is_meant).any(|meaning| meaning.iter().any(|known| text.contains(known)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_words_find_what_is_meant() {
        assert!(matches_search("orbit", "rotate"), "another word");
        assert!(
            matches_search("screenshot without background", "save backg"),
            "and the text's own beside it"
        );
        assert!(matches_search("anything", ""), "no word finds all");
        assert!(!matches_search("orbit", "save"), "another meaning");
        assert!(!matches_search("orbit", "ro"), "too short to tell");
        assert!(!matches_search("screenshot", "save orbit"), "all words count");
    }

    #[test]
    fn words_are_in_lower_case() {
        let words = SYNONYMS.iter().flat_map(|meaning| meaning.iter());
        let upper = words.filter(|word| word.chars().any(char::is_uppercase));
        assert_eq!(upper.count(), 0, "searches are");
    }
}
