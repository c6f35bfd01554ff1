//! How far a sweep has come.

use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error, gone when the sweep ends. Without a terminal there
/// is none.
pub struct Bar(ProgressBar);

impl Bar {
    pub fn new(file: &str, targets: usize) -> Self {
        let bar = ProgressBar::new(targets as u64).with_message(file.to_owned());
        let template = "{msg} {wide_bar} {human_pos} of {human_len} targets, {eta} left";
        Self(match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }

    pub fn advance(&self, targets: usize) {
        self.0.inc(targets as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
