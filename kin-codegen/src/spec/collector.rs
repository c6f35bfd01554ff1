//! Collects diagnostics while a file is read, so that one run tells all.

use super::places::Places;
use super::{Diagnostic, Diagnostics, Location, Severity, Source, did_you_mean, list_names};
use std::collections::{HashMap, HashSet};

/// Diagnostics of one file that look for the name that was meant.
const SUGGESTIONS: usize = 100;

/// The diagnostics about one source so far.
pub(crate) struct Collector<'s> {
    source: &'s Source,
    places: Places<'s>,
    list: Vec<Diagnostic>,
    /// The places that were ever reported.
    reported: HashSet<Location>,
    warnings: Vec<Diagnostic>,
}

impl<'s> Collector<'s> {
    pub(crate) fn new(source: &'s Source) -> Self {
        Collector {
            source,
            places: Places::of(&source.text),
            list: Vec::new(),
            reported: HashSet::new(),
            warnings: Vec::new(),
        }
    }

    /// The place of a byte offset of the source.
    pub(crate) fn place(&self, offset: usize) -> Location {
        self.places.at(offset)
    }

    /// Reports a place.
    pub(crate) fn at(
        &mut self,
        at: Location,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let diagnostic = Diagnostic::whole(reason, remedy).in_text(at, &self.places);
        self.reported.insert(at);
        self.list.push(diagnostic);
    }

    /// Warns of a place: what is there changes no frame and no joint value.
    pub(crate) fn warn(
        &mut self,
        at: Location,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let warning = Diagnostic::whole(reason, remedy).in_text(at, &self.places);
        self.warnings.push(warning.warning());
    }

    /// Warns of the robot as a whole.
    pub(crate) fn warn_whole(&mut self, reason: impl Into<String>, remedy: impl Into<String>) {
        self.warnings
            .push(Diagnostic::whole(reason, remedy).warning());
    }

    /// Takes the errors that came after there were `before` of them.
    pub(crate) fn take_since(&mut self, before: usize) -> Vec<Diagnostic> {
        self.list.split_off(before)
    }

    /// How many errors there are.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Reports errors that were taken before.
    pub(crate) fn put(&mut self, errors: impl IntoIterator<Item = Diagnostic>) {
        self.list.extend(errors);
    }

    /// Warns of what would be errors elsewhere.
    pub(crate) fn put_warnings(&mut self, errors: &[Diagnostic]) {
        let warnings = errors.iter().cloned().map(Diagnostic::warning);
        self.warnings.extend(warnings);
    }

    /// Takes the warnings, in the order of the file; what is found at several places is told at the
    /// first.
    pub(crate) fn take_warnings(&mut self) -> Vec<Diagnostic> {
        let mut all = std::mem::take(&mut self.warnings);
        all.sort_by_key(|warning| (warning.at.is_none(), warning.at));
        all.dedup();
        let key = |warning: &Diagnostic| [warning.reason.clone(), warning.remedy.clone()];
        let mut places: HashMap<[String; 2], usize> = HashMap::new();
        all.iter()
            .for_each(|it| *places.entry(key(it)).or_default() += 1);
        let mut warnings = Vec::new();
        for mut warning in all {
            // Told, it is no longer there.
            match places.remove(&key(&warning)) {
                None => continue,
                Some(1) => {}
                Some(2) => warning.reason += ", and at one other place",
                Some(n) => warning.reason += &format!(", and at {} other places", n - 1),
            }
            warnings.push(warning);
        }
        warnings
    }

    /// Reports the robot as a whole.
    pub(crate) fn whole(&mut self, reason: impl Into<String>, remedy: impl Into<String>) {
        self.list.push(Diagnostic::whole(reason, remedy));
    }

    /// A remedy that names the nearest of the robot's names. The mistakes of a
    /// file that has hundreds of them have one cause: they do without.
    pub(crate) fn nearest_of(&self, word: &str, names: &[&str]) -> String {
        match self.reported.len() < SUGGESTIONS {
            true => did_you_mean(word, names),
            false => format!("use one of {}", list_names(names)),
        }
    }

    /// As [`nearest_of`](Self::nearest_of), of a link that the file does not have.
    pub(crate) fn link_for(&self, word: &str, names: &[&str]) -> String {
        if names.is_empty() {
            return "add a link of that name; if this file is a part of a robot, use the one that \
                    includes it"
                .into();
        }
        let remedy = self.nearest_of(word, names);
        match remedy.starts_with("did") {
            true => remedy,
            false => format!("{remedy}, or add a link of that name"),
        }
    }

    /// Reports that the user has to choose, from what is listed in lines of
    /// their own.
    pub(crate) fn choice(
        &mut self,
        reason: impl Into<String>,
        listed: impl IntoIterator<Item = String>,
        remedy: impl Into<String>,
    ) {
        let mut choice = Diagnostic::whole(reason, remedy);
        choice.severity = Severity::Ambiguity;
        for line in listed {
            choice.reason += "\n  ";
            choice.reason += &Diagnostic::whole(line, "").reason;
        }
        self.list.push(choice);
    }

    /// Whether there is a diagnostic about this very place.
    pub(crate) fn mentions(&self, at: Location) -> bool {
        self.reported.contains(&at)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The value, if there was nothing to report.
    pub(crate) fn unless_any<T>(self, value: Option<T>) -> Result<T, Diagnostics> {
        match (Diagnostics::of(&self.source.path, self.list), value) {
            (None, Some(value)) => Ok(value),
            (Some(diagnostics), _) => Err(diagnostics),
            // Whoever gives up says why; should one forget, the user still
            // gets an error instead of a blank line.
            (None, None) => Err(Diagnostics::one(
                &self.source.path,
                Diagnostic::whole(
                    "the file cannot be read, for a reason that was not recorded",
                    "report this file as a defect of kin-codegen",
                ),
            )),
        }
    }
}
