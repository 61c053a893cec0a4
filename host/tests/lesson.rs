//! The lesson, `docs/lesson.md`, says what the program does: its commands are run, what they say
//! is what stands below them, and the pictures are those that they make.
//!
//! A command stands in a block of `sh`, what it says in the block of `text` after it. To renew
//! both and the pictures: `WHITTED_RENEW=1 cargo test -p whitted-host --test lesson`.

mod common;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{decibels, errors, pixels, said, whitted};

/// Pictures this near are the same: a change of the last bits somewhere is none of the lesson.
const SAME: f64 = 50.0;
/// All pictures together, in bytes: they are in everybody's clone.
const ROOM: u64 = 1_500_000;

/// A command of the page, and what stands below it.
struct Step {
    command: String,
    /// The lines of the block of text after it; none where it has nothing to say.
    said: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/lesson.md")).expect("the lesson is there")
}

/// The page cut at its fences: prose, block, prose, …, each block with its language's line.
fn pieces(page: &str) -> Vec<&str> {
    page.split("```").collect()
}

fn steps(page: &str) -> Vec<Step> {
    let pieces = pieces(page);
    let blocks: Vec<&str> = pieces.iter().skip(1).step_by(2).copied().collect();
    let mut steps = Vec::new();
    for (at, block) in blocks.iter().enumerate() {
        let Some(command) = block.strip_prefix("sh\n") else { continue };
        let after = blocks.get(at + 1).and_then(|next| next.strip_prefix("text\n"));
        let said = after.unwrap_or_default().to_owned();
        steps.push(Step { command: command.trim().to_owned(), said });
    }
    steps
}

/// The file that a command writes.
fn written(command: &str) -> Option<&str> {
    command.split_whitespace().skip_while(|&word| word != "-o").nth(1)
}

/// The same, if it is a picture.
fn picture(command: &str) -> Option<&str> {
    written(command).filter(|name| name.ends_with(".png"))
}

/// Runs a command at the root, its file going elsewhere; says what it said but for times, and
/// for the rays where it shows something else than light.
fn run(command: &str, out: &Path) -> String {
    let mut words: Vec<&str> = command.split_whitespace().collect();
    assert_eq!(words.first(), Some(&"whitted"), "{command}");
    words.remove(0);
    if let Some(at) = words.iter().position(|&word| word == "-o") {
        words[at + 1] = out.to_str().expect("a plain name");
    }
    let output = whitted(&root(), &words);
    assert!(output.status.success(), "{command}\n{}", errors(&output));
    let all = said(&output) + &errors(&output);
    // Distances and normals have neither rays nor paths of light.
    if all.lines().any(|line| line.starts_with("0 rays")) {
        return String::new();
    }
    let unsaid = |line: &str| line.contains(" s (") || Path::new(line) == out;
    let lines = all.lines().filter(|line| !unsaid(line));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn commands_say_and_draw_what_the_page_shows() {
    let page = page();
    let steps = steps(&page);
    let renew = std::env::var_os("WHITTED_RENEW").is_some();
    let place = tempfile::tempdir().expect("a directory");
    let (next, flaws) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let news = Mutex::new(vec![String::new(); steps.len()]);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some((at, step)) = {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    steps.get(at).map(|step| (at, step))
                } {
                    let name = written(&step.command).unwrap_or_default();
                    let out = place.path().join(format!("{at}"));
                    let out = out.with_extension(Path::new(name).extension().unwrap_or_default());
                    let now = run(&step.command, &out);
                    if renew {
                        if let Some(name) = picture(&step.command) {
                            std::fs::copy(&out, root().join(name)).expect("docs can be written");
                        }
                    } else {
                        let note = |text| flaws.lock().unwrap().push(text);
                        if now != step.said {
                            note(format!("{}\nsays\n{now}not\n{}", step.command, step.said));
                        }
                        if let Some(name) = picture(&step.command) {
                            let (a, b) = (pixels(&out), pixels(&root().join(name)));
                            if a.len() != b.len() || decibels(&a, &b) < SAME {
                                note(format!("{}\ndraws another picture", step.command));
                            }
                        }
                    }
                    news.lock().unwrap()[at] = now;
                }
            });
        }
    });
    if renew {
        let mut text = page.clone();
        for (step, new) in steps.iter().zip(news.into_inner().unwrap()) {
            let block = |said: &str| format!("{}\n```\n```text\n{said}```", step.command);
            text = text.replace(&block(&step.said), &block(&new));
        }
        std::fs::write(root().join("docs/lesson.md"), text).expect("docs can be written");
    }
    let flaws = flaws.into_inner().unwrap();
    assert!(flaws.is_empty(), "{}", flaws.join("\n"));
}

#[test]
fn pictures_are_shown_and_small() {
    let page = page();
    let mut bytes = 0;
    let pictures = root().join("docs/pictures");
    // What the boards draw lies in a directory beside them.
    for name in common::files(&pictures).into_iter().filter(|name| name.ends_with(".png")) {
        assert!(page.contains(&format!("](pictures/{name})")), "{name} is not in the lesson");
        let command = format!("-o docs/pictures/{name}");
        assert!(page.contains(&command), "no command says how {name} is made");
        bytes += pictures.join(name).metadata().expect("it is there").len();
    }
    assert!(bytes < ROOM, "{bytes} bytes of pictures");
}
