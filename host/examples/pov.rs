//! Writes a scene in POV-Ray's language to standard output: `pov SCENE`.

use std::process::ExitCode;

use whitted_host::document::Size;

fn main() -> ExitCode {
    let Some(path) = std::env::args_os().nth(1) else {
        eprintln!("usage: pov SCENE");
        return ExitCode::from(2);
    };
    match whitted_host::read::read(path.as_ref()) {
        Ok(document) => {
            let size = document.size.unwrap_or(Size { width: 320, height: 240 });
            print!("{}", whitted_host::pov::to_pov(&document, size));
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
