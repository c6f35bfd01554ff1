//! The `kin` command.

use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = kin_cli::run(std::env::args_os());
    let written = [
        io::stdout().write_all(done.stdout.as_bytes()),
        io::stdout().flush(),
        io::stderr().write_all(done.stderr.as_bytes()),
    ];
    match written.into_iter().find_map(Result::err) {
        // Whoever reads has seen enough: `kin explain arm.urdf | head -1`.
        Some(error) if error.kind() == ErrorKind::BrokenPipe => done.exit.into(),
        Some(error) => {
            let _ = writeln!(io::stderr(), "the output cannot be written: {error}");
            ExitCode::FAILURE
        }
        None => done.exit.into(),
    }
}
