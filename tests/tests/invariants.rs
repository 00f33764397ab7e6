//! The invariants of ARCHITECTURE.md, each the absence of something.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::Decl;
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_tests::cases::{self, Case, Width};
use pcl2_tests::compilers::{check, files, folder};
use pcl2_tests::renamed::{Codes, PREFIX};
use pcl2_tests::table::same_text;
use pcl2_tests::{none, pcl2, root, run};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn decls() -> Vec<Decl> {
    let catalogue = Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut Vec::new());
    catalogue.decls().cloned().collect()
}

/// Rust files of the crates, without what is compiled for tests only: name and text.
fn rust(folders: &[&str]) -> Vec<(String, String)> {
    let mut texts = Vec::new();
    for path in files(&root().join("crates"), "rs") {
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        let wanted = folders.iter().any(|folder| name.split('/').nth(2) == Some(*folder));
        let is_test = name.contains("/tests/") || name.ends_with("/tests.rs");
        if wanted && !is_test {
            let text = fs::read_to_string(&path).unwrap();
            let end = text.find("#[cfg(test)]\nmod tests").unwrap_or(text.len());
            texts.push((name, text[..end].to_owned()));
        }
    }
    assert!(texts.len() > 50, "only {} files", texts.len());
    texts
}

/// The lines of a text without comments, numbered from 1.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"));
    lines.map(|(i, line)| (i + 1, line.split(" // ").next().unwrap_or(line)))
}

// 0. Dependencies point down.

/// What each crate may depend on.
const ARROWS: [(&str, &[&str]); 8] = [
    ("pcl2-lang", &[]),
    ("pcl2-cfg", &["pcl2-lang"]),
    ("pcl2-net", &["pcl2-lang"]),
    ("pcl2-emit", &["pcl2-lang"]),
    ("pcl2-sim", &["pcl2-lang"]),
    ("pcl2-draw", &["pcl2-lang"]),
    ("pcl2-cli", &["pcl2-lang", "pcl2-cfg", "pcl2-net", "pcl2-emit", "pcl2-sim", "pcl2-draw"]),
    ("xtask", &["pcl2-lang", "pcl2-cfg", "pcl2-net", "pcl2-emit", "pcl2-sim"]),
];

#[test]
fn dependencies_point_down() {
    let mut complaints = Vec::new();
    let mut folders: Vec<PathBuf> =
        fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    for folder in folders {
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        let Some((_, allowed)) = ARROWS.iter().find(|(known, _)| *known == name) else {
            complaints.push(format!("{name} has no row in the table of this test"));
            continue;
        };
        let manifest: toml::Table = toml::from_str(&fs::read_to_string(folder.join("Cargo.toml")).unwrap()).unwrap();
        for table in ["dependencies", "build-dependencies"] {
            let used = manifest.get(table).and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::keys);
            let ours = used.filter(|used| used.starts_with("pcl2") && !allowed.contains(&used.as_str()));
            complaints.extend(ours.map(|used| format!("{name} depends on {used}")));
        }
    }
    none(&complaints);
}

// 1. No block is known to a crate.

/// Words that the compiler has for itself and that are a function code's name too, each with the reason.
const OWN_WORDS: [(&str, &str); 7] = [
    ("add", "the suite has rustup add components"),
    ("eq", "short for equation in a declaration's comment"),
    ("hold", "a value of `bad` in [io]"),
    ("min", "the minutes of a plot's axis"),
    ("ratio", "a column of the benchmark's table"),
    ("sqrt", "the library function of C that compilers make of plain code"),
    ("step", "the function of a program, and the entry of a kernel, that runs one scan"),
];

#[test]
fn no_crate_knows_a_function_code() {
    let names: BTreeSet<String> = decls().into_iter().map(|decl| decl.name).collect();
    assert!(names.len() > 20);
    let mut complaints = Vec::new();
    for (file, text) in rust(&["src", "build.rs"]) {
        for (number, line) in code(&text) {
            let literals = line.split('"').skip(1).step_by(2);
            let known = literals.filter(|word| names.contains(*word) && !OWN_WORDS.iter().any(|(own, _)| own == word));
            complaints.extend(known.map(|word| format!("{file}:{number}: \"{word}\"")));
            for name in &names {
                let symbol = format!("pcl2_{name}");
                let at = line.find(&symbol).map(|at| &line[at + symbol.len()..]);
                let ends =
                    |rest: &str| !rest.starts_with(|letter: char| letter.is_ascii_alphanumeric() || letter == '_');
                let entries = ["_init", "_tune", "_check"];
                if at.is_some_and(|rest| ends(rest) || entries.iter().any(|entry| rest.starts_with(entry))) {
                    complaints.push(format!("{file}:{number}: {symbol}"));
                }
            }
        }
    }
    none(&complaints);
}

/// Cases without blocks of their own, whose program can be rewritten.
fn catalogue_cases() -> Vec<Case> {
    let plain = |case: &Case| case.is_plain() && !case.name.starts_with("errors_");
    cases::all().into_iter().filter(plain).collect()
}

#[test]
fn a_catalogue_with_other_names_gives_the_same_results() {
    let codes = Codes::new(decls().into_iter().map(|decl| (decl.name, decl.stem)));
    let mut complaints = Vec::new();
    let cases = catalogue_cases();
    assert!(cases.len() > 15);
    for case in cases {
        let work = folder();
        codes.write(&work.path().join("renamed"));
        let mut copy = case.clone();
        copy.folder = work.path().join("case");
        copy_folder(&case.folder, &copy.folder);
        let text = fs::read_to_string(case.folder.join("main.cfg")).unwrap();
        fs::write(copy.folder.join("main.cfg"), codes.program(&text)).unwrap();
        if let Ok(text) = fs::read_to_string(case.folder.join("stimulus.csv")) {
            fs::write(copy.folder.join("stimulus.csv"), codes.stimulus(&text)).unwrap();
        }
        complaints.extend(same_up_to_names(&case, &copy).err().map(|why| format!("{}: {why}", case.name)));
    }
    none(&complaints);
}

fn same_up_to_names(case: &Case, copy: &Case) -> Result<(), String> {
    let mut command = copy.run("cc", Width::F64);
    command.args(["--blocks", "../renamed"]);
    let (original, renamed) = (case.trace(case.run("embedded", Width::F64))?, copy.trace(command)?);
    same_text("trace", &original, &renamed)?;
    let built = [folder(), folder()];
    check(case.command("build").arg("-o").arg(built[0].path()));
    check(copy.command("build").args(["--blocks", "../renamed", "-o"]).arg(built[1].path()));
    let [original, renamed] = built.map(|folder| {
        let path = files(folder.path(), "json").pop().expect("a model");
        let text = fs::read_to_string(path).unwrap();
        // The layout's hash goes over names, those of image words too.
        text.lines().filter(|line| !line.contains("\"layout\":")).collect::<Vec<_>>().join("\n")
    });
    same_text("model", &original, &renamed.replace(PREFIX, ""))
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy_folder(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

// 2. Kernels exist once, in C.

#[test]
fn every_declaration_has_its_kernel_and_every_kernel_its_declaration() {
    let source = root().join("runtime-c/src");
    let mut complaints = Vec::new();
    let mut stems = BTreeSet::new();
    for decl in decls().iter().filter(|decl| !decl.is_composite()) {
        let file = if decl.inline { format!("{}_inline.h", decl.stem) } else { format!("{}.c", decl.stem) };
        let path = source.join(&decl.group).join(&file);
        let text = fs::read_to_string(&path).unwrap_or_default();
        if !text.contains(&format!("pcl2_{}(", decl.name)) {
            complaints.push(format!("{} has no kernel in {}/{file}", decl.name, decl.group));
        }
        stems.insert((decl.group.clone(), decl.stem.clone()));
    }
    for path in files(&source, "c").into_iter().chain(files(&source, "h")) {
        let group = path.parent().unwrap().file_name().unwrap().to_string_lossy().into_owned();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let stem = name.split('.').next().unwrap().to_owned();
        let text = fs::read_to_string(&path).unwrap();
        let inline = stem.strip_suffix("_inline").map(str::to_owned);
        let is_kernel =
            inline.is_some() || text.contains(&format!("#include \"pcl2_{stem}.h\"\n")) && text.contains("PCL2_KERNEL");
        if is_kernel && !stems.contains(&(group.clone(), inline.unwrap_or(stem))) {
            complaints.push(format!("{group}/{name} has no declaration"));
        }
    }
    none(&complaints);
}

#[test]
fn a_kernel_that_drifts_from_its_declaration_does_not_compile() {
    let work = folder();
    let case = cases::find("user_block");
    copy_folder(&case.folder, work.path());
    let kernel = work.path().join("blocks/glide.c");
    let text = fs::read_to_string(&kernel).unwrap();
    let drifted = text.replace(
        "pcl2_glide_tune(struct pcl2_glide *self, pcl2_real rate,",
        "pcl2_glide_tune(struct pcl2_glide *self, int32_t rate,",
    );
    assert_ne!(text, drifted);
    fs::write(&kernel, drifted).unwrap();
    let output = run(pcl2().arg("run").arg(work.path()).args(["--steps", "1", "--engine", "cc"]));
    assert_eq!(output.status.code(), Some(3));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("pcl2_glide_tune"), "{said}");
}

// 3. Only the command touches files, clocks and the terminal.

#[test]
fn libraries_touch_no_file_no_clock_and_no_terminal() {
    let forbidden = [
        "std::fs",
        "std::env",
        "std::time",
        "std::process",
        "std::net",
        "std::thread",
        "std::io::stdin",
        "io::stdout",
        "io::stderr",
        "println!",
        "print!(",
        "dbg!(",
        "SystemTime",
        "use std::{",
    ];
    let mut complaints = Vec::new();
    for (file, text) in rust(&["src"]) {
        if file.starts_with("crates/pcl2-cli/") || file.starts_with("crates/xtask/") {
            continue;
        }
        for (number, line) in code(&text) {
            let found = forbidden.iter().filter(|word| line.contains(**word));
            complaints.extend(found.map(|word| format!("{file}:{number}: {word}")));
        }
    }
    none(&complaints);
}

// 5. Same input bytes, same output bytes.

#[test]
fn the_same_source_gives_the_same_bytes_from_any_folder() {
    for name in ["paper_gpc", "composite_many", "user_block", "names_clash", "errors_sizes"] {
        let case = cases::find(name);
        let work = [folder(), folder()];
        let mut copies = Vec::new();
        for (i, place) in ["a", "deeper/inside/b"].iter().enumerate() {
            let mut copy = case.clone();
            copy.folder = work[i].path().join(place);
            copy_folder(&case.folder, &copy.folder);
            copies.push(everything(&copy));
        }
        assert!(copies[0].len() > 1, "{name}");
        assert_eq!(copies[0], copies[1], "{name}");
        for bytes in copies[0].iter().map(|(_, bytes)| String::from_utf8_lossy(bytes)) {
            assert!(!bytes.contains(&work[0].path().display().to_string()) && !bytes.contains("deeper"), "{name}");
        }
    }
}

/// All that the command says and writes about a case: name and bytes.
fn everything(case: &Case) -> Vec<(String, Vec<u8>)> {
    let checked = run(case.command("check").arg("-v"));
    let mut all = vec![("out".to_owned(), checked.stdout), ("err".to_owned(), checked.stderr)];
    all.push(("graph".to_owned(), run(case.command("graph").args(["-o", "-"])).stdout));
    if case.has("trace.csv") {
        all.push(("trace".to_owned(), case.trace(case.run("cc", Width::F32)).unwrap().into_bytes()));
        let out = folder();
        check(case.command("build").arg("-o").arg(out.path()));
        for extension in ["c", "h", "json"] {
            for path in files(out.path(), extension) {
                all.push((path.strip_prefix(out.path()).unwrap().display().to_string(), fs::read(&path).unwrap()));
            }
        }
    }
    all
}

// 6. No `unsafe` outside one file.

#[test]
fn unsafe_stands_in_one_file() {
    let mut found = BTreeSet::new();
    for (file, text) in rust(&["src", "build.rs", "tests", "benches"]) {
        let words = |line: &str| {
            line.split(|letter: char| !letter.is_alphanumeric() && letter != '_').any(|word| word == "unsafe")
        };
        if code(&text).any(|(_, line)| words(line)) {
            found.insert(file);
        }
    }
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["crates/pcl2-sim/src/ffi.rs"]);
}

// 7. The binary carries everything inside itself.

#[test]
fn the_command_works_in_an_empty_environment() {
    let (empty, out) = (folder(), folder());
    let alone = |args: &[&str]| {
        let mut command = Command::new(pcl2().get_program());
        command.env_clear().current_dir(empty.path()).args(args);
        run(&mut command)
    };
    let project = cases::find("gpc_closed_loop").folder.display().to_string();
    let target = out.path().display().to_string();
    for args in [
        &["check", &project][..],
        &["run", &project, "--steps", "5", "--trace", "-", "--engine", "embedded"],
        &["run", &project, "--steps", "5", "--real", "f32"],
        &["build", &project, "-o", &target, "--emit", "c"],
        &["graph", &project, "-o", "-"],
        &["blocks"],
        &["explain", "P0203"],
    ] {
        let output = alone(args);
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(out.path().join("gpc_closed_loop.c").is_file());
    assert_eq!(fs::read_dir(empty.path()).unwrap().count(), 0);
    let compiled = alone(&["run", &project, "--steps", "5", "--engine", "cc"]);
    assert_eq!(compiled.status.code(), Some(3));
    let said = String::from_utf8_lossy(&compiled.stderr);
    assert!(said.contains("`cc`"), "{said}");
}
