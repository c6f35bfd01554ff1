//! How far a long computation has come.

use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error, gone when it ends. Without a terminal there
/// is none.
pub struct Bar(ProgressBar);

impl Bar {
    /// `what` is counted, in the plural.
    pub fn new(file: &str, count: usize, what: &str) -> Self {
        let bar = ProgressBar::new(count as u64).with_message(file.to_owned());
        let template =
            format!("{{msg}} {{wide_bar}} {{human_pos}} of {{human_len}} {what}, {{eta}} left");
        Self(match ProgressStyle::with_template(&template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }

    pub fn advance(&self, count: usize) {
        self.0.inc(count as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
