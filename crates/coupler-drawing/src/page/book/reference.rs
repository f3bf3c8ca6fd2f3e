//! How a plate is referred to: by its page, and by the number of its figure on the page, if that has several.

/// The page and the figure in words.
pub(super) fn reference(page: usize, figure: Option<usize>) -> String {
    in_form(Form::Words, page, figure)
}

/// The figure in words; `None` if the page has one.
pub(super) fn figure_words(figure: Option<usize>) -> Option<String> {
    figure.map(|figure| format!("figure {figure}"))
}

/// How much is said of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// "page 5, figure 12".
    Words,
    /// "5, figure 12", of numbers below what is said to be a page.
    FigureInWords,
    /// "5, 12", where is said what they are.
    Numbers,
}

impl Form {
    /// All, the longest first.
    pub const ALL: [Form; 3] = [Form::Words, Form::FigureInWords, Form::Numbers];
}

/// The page and the figure in a form.
pub(super) fn in_form(form: Form, page: usize, figure: Option<usize>) -> String {
    let [page_word, figure_word] = match form {
        Form::Words => ["page ", "figure "],
        Form::FigureInWords => ["", "figure "],
        Form::Numbers => ["", ""],
    };
    let figure = figure.map_or(String::new(), |figure| format!(", {figure_word}{figure}"));
    format!("{page_word}{page}{figure}")
}
