//! Sweeps as text for a terminal.

use super::{Comparison, Draw, Fault, FormSolution, Found, Kind, Replay, Split, Tally};
use std::fmt::{self, Display, Formatter};

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let aligned = match self.draw {
            Draw::Anywhere => "",
            Draw::Aligned => "aligned ",
        };
        writeln!(
            f,
            "  {} {aligned}targets of seed {} in {:.1} s, {:.1} µs each",
            self.targets, self.seed, self.seconds, self.microseconds
        )?;
        let histogram = self.solutions.iter().rev();
        let histogram: Vec<String> = histogram
            .map(|(count, targets)| format!("{count} to {targets}"))
            .collect();
        writeln!(f, "  solutions: {}", histogram.join(", "))?;
        writeln!(
            f,
            "  worst residual {:.1e} m, at {}",
            self.worst_residual,
            listed(&self.worst_at)
        )?;
        write!(f, "  lost {}", self.lost)?;
        if self.lost_up_to > 0.0 {
            write!(f, " (up to a conditioning of {:.1e})", self.lost_up_to)?;
        }
        writeln!(f, ", unsound {}, doubled {}", self.unsound, self.doubled)?;
        writeln!(
            f,
            "  near singular {}, below a conditioning of {:.1e}; {} of these unanswered",
            self.near_singular, self.near_singular_below, self.unanswered
        )?;
        if let Some(comparison) = &self.oracle {
            writeln!(f, "  {comparison}")?;
        }
        self.faults
            .iter()
            .try_for_each(|fault| writeln!(f, "  {fault}"))
    }
}

impl Display for Split {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.near_singular {
            0 => write!(f, "{}", self.regular),
            near => write!(f, "{} and {near} near singular", self.regular),
        }
    }
}

impl Display for Comparison {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "numerical search: {} solutions of {} targets; missing {}, extra {}",
            self.solutions, self.targets, self.missing, self.extra
        )?;
        let asides = [
            (self.overlooked, "overlooked by the search"),
            (self.skipped, "targets skipped as near singular"),
        ];
        let asides = asides.iter().filter(|(count, _)| *count > 0);
        asides
            .into_iter()
            .try_for_each(|(count, what)| write!(f, "; {count} {what}"))
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let near = if self.near_singular {
            ", near singular,"
        } else {
            ""
        };
        write!(f, "{}{near} at {}", self.kind, listed(&self.q))
    }
}

impl Display for Kind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Unanswered => "unanswered",
            Kind::Lost => "lost",
            Kind::Unsound => "unsound",
            Kind::Doubled => "doubled",
            Kind::Missing => "missing",
            Kind::Extra => "extra",
        })
    }
}

/// All digits, separated by commas, to be given back with `--at`.
fn listed(q: &[f64]) -> String {
    let values: Vec<String> = q.iter().map(|x| format!("{x:?}")).collect();
    values.join(",")
}

impl Display for Replay {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let near = if self.near_singular {
            ", near singular"
        } else {
            ""
        };
        writeln!(f, "  q            {}", listed(&self.q))?;
        writeln!(f, "  conditioning {:.1e}{near}", self.conditioning)?;
        writeln!(f, "  translation  {}", listed(&self.translation))?;
        for (i, row) in self.rotation.iter().enumerate() {
            let title = if i == 0 { "rotation" } else { "" };
            writeln!(f, "  {title:12} {}", listed(row))?;
        }
        writeln!(f, "  closed form{}", unless_any(&self.solutions))?;
        for (i, solution) in self.solutions.iter().enumerate() {
            writeln!(f, "  {:>4}. {solution}", i + 1)?;
        }
        writeln!(f, "  numerical search{}", unless_any(&self.found))?;
        for (i, found) in self.found.iter().enumerate() {
            writeln!(f, "  {:>4}. {found}", i + 1)?;
        }
        let Tally {
            lost,
            unsound,
            doubled,
            oracle,
            ..
        } = &self.tally;
        writeln!(f, "  lost {lost}, unsound {unsound}, doubled {doubled}")?;
        oracle
            .iter()
            .try_for_each(|comparison| writeln!(f, "  {comparison}"))
    }
}

/// What is said instead of a list: the target of q has a solution, q itself.
fn unless_any<T>(list: &[T]) -> &'static str {
    match list {
        [] => ": none, though q is a solution",
        _ => "",
    }
}

impl Display for FormSolution {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: branch {}, residual {:.1e} m, conditioning {:.1e}",
            listed(&self.q),
            self.branch,
            self.residual,
            self.conditioning
        )?;
        if self.singular {
            write!(f, ", singular")?;
        }
        match self.found {
            Some(i) => write!(f, ", found as {}", i + 1)?,
            None => write!(f, ", not found")?,
        }
        if self.is_q {
            write!(f, ", this is q")?;
        }
        Ok(())
    }
}

impl Display for Found {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: residual {:.1e} m, conditioning {:.1e}",
            listed(&self.q),
            self.residual,
            self.conditioning
        )?;
        match self.solution {
            Some(i) => write!(f, ", answered as {}", i + 1),
            None => write!(f, ", not answered"),
        }
    }
}
