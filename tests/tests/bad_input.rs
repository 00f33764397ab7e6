//! Input that is no program: a clear error at the right place, exit status 1, nothing written, no panic, little memory.

use pcl2_tests::compilers::folder;
use pcl2_tests::{none, pcl2, run};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs the command in 512 MiB and 10 s of processor time.
fn bounded(args: &[&str], at: &Path) -> (Option<i32>, String) {
    let script = "ulimit -v 524288; ulimit -t 10; exec \"$0\" \"$@\"";
    let mut command = Command::new("sh");
    command.args(["-c", script]).arg(pcl2().get_program()).args(args).current_dir(at).env("NO_COLOR", "1");
    let output = run(&mut command);
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Name, content, and what the message has in it.
fn programs() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let text = |text: &str| text.as_bytes().to_vec();
    let line = |statement: &str| format!("CONTROL\n1 x = msc ( : 1. )\n{statement}\nEND\n").into_bytes();
    vec![
        ("empty", Vec::new(), "empty.cfg:1:1"),
        ("blank", text("\n\n   \n"), "error[P00"),
        ("windows", utf_16("CONTROL\n1 x = msc ( : 1. )\nEND\n", u16::to_le_bytes), "found UTF-16"),
        ("windows_big", utf_16("CONTROL\nEND\n", u16::to_be_bytes), "found UTF-16"),
        ("unequal", line("2 y = first ( x != 2. : 1., 1., )"), "error[P0011]"),
        ("zeros", vec![0; 1000], "error[P00"),
        ("binary", (0..=255).cycle().take(100_000).collect(), "error[P00"),
        ("no_end", text("CONTROL\n1 x = msc ( : 1. )\n"), "error[P0006]"),
        ("no_section", text("1 x = msc ( : 1. )\nEND\n"), "error[P00"),
        ("long_line", line(&format!("2 y = msc ( : {} )", "1".repeat(1_000_000))), "long_line.cfg:3:15"),
        ("long_name", line(&format!("2 {} = msc ( : 1. )", "y".repeat(1_000_000))), "long_name.cfg:3:3"),
        ("many_blanks", line(&format!("2 y {} = mcs ( : 1. )", " ".repeat(1_000_000))), "error[P0101]"),
        ("parentheses", line(&format!("2 y = msc {} 1. )", "( ".repeat(100_000))), "parentheses.cfg:3"),
        ("many_closed", line(&format!("2 y = msc ( : 1. {}", ") ".repeat(100_000))), "many_closed.cfg:3"),
        ("index", line(&format!("2 y = first ( x{} : 1., 1., )", "[1]".repeat(100_000))), "index.cfg:3"),
        ("huge_size", line("2 y = setvec ( 2000000000 : )"), "error[P0208]"),
        ("huge_product", line("2 y = setmat ( 65536, 65536 : )"), "error[P0208]"),
        (
            "horizon",
            line("2 p = setvec ( 4 : )\n3 u = gpc2 ( x, x, p, x, 0, -10, 1 : 0., -10., 10., 0.1 )"),
            "error[P0207]",
        ),
        (
            "work_size",
            line("2 p = setvec ( 4 : )\n3 u = gpc2 ( x, x, p, x, 0, 2000000000, 1 : 0., -1., 1., 0.1 )"),
            "error[P02",
        ),
        (
            "limits",
            line("2 p = setvec ( 4 : )\n3 u = gpc2 ( x, x, p, x, 0, 10, 1 : 0., 10., -10., 0.1 )"),
            "error[P0207]",
        ),
        ("number", line("99999999999 y = msc ( : 1. )"), "error[P0004]"),
        ("full_width", "CONTROL\n1 x = msc （ : 1. )\nEND\n".as_bytes().to_vec(), "full_width.cfg:2:11"),
        ("outside", line("2 y = setvec ( 2 : \"../outside.txt\" )"), "outside the project"),
        ("absolute", line("2 y = setvec ( 2 : \"/etc/passwd\" )"), "outside the project"),
        ("directory", line("2 y = setvec ( 2 : \"folder\" )"), "error[P0209]"),
        ("device", line("2 y = setvec ( 2 : \"link\" )"), "error[P0209]"),
        ("too_long", line("2 y = setvec ( 2 : \"three.txt\" )"), "error[P0209]"),
        ("no_numbers", line("2 y = setvec ( 2 : \"secret.txt\" )"), "error[P0209]"),
        ("many_errors", line(&"2 y = nothing ( z : )\n".repeat(20_000)), "error[P0101]"),
        ("carriage", text("CONTROL\r1 x = mcs ( : 1. )\rEND\r"), "carriage.cfg:2:7"),
    ]
}

/// A text as the shells of Windows save it, with a mark before it.
fn utf_16(text: &str, bytes: impl Fn(u16) -> [u8; 2]) -> Vec<u8> {
    std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// Nets and blocks of one's own are read as programs are.
#[test]
fn nets_and_blocks_that_are_no_text_are_told_once() {
    let work = folder();
    let net = "int q = lamp ( int b : )\nSTATE off MARKED DRIVES q\nEND\n";
    let block = "int y = half ( int x : )\nINLINE\n";
    let program = "CONTROL\n1 b = msi ( : 1 )\n2 c = lamp ( b : )\nEND\n";
    fs::write(work.path().join("lamp.net"), utf_16(net, u16::to_le_bytes)).unwrap();
    fs::write(work.path().join("main.cfg"), program).unwrap();
    fs::create_dir(work.path().join("own")).unwrap();
    fs::write(work.path().join("own/half.fc"), utf_16(block, u16::to_le_bytes)).unwrap();
    fs::write(work.path().join("half.cfg"), "CONTROL\n1 b = msi ( : 1 )\n2 c = half ( b : )\nEND\n").unwrap();
    for args in [&["check", "lamp.net"][..], &["check", "main.cfg"], &["check", "--blocks", "own", "half.cfg"]] {
        let (status, said) = bounded(args, work.path());
        assert_eq!(status, Some(1), "{args:?}: {said}");
        assert!(said.contains("error[P0008]: expected ASCII or UTF-8 text, found UTF-16"), "{args:?}: {said}");
        assert_eq!(said.matches("error[").count(), 1, "{args:?}: {said}");
    }
}

fn prepare(at: &Path) {
    fs::write(at.join("three.txt"), "1. 2. 3.\n").unwrap();
    fs::write(at.join("secret.txt"), "topsecret 2.\n").unwrap();
    fs::create_dir(at.join("folder")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", at.join("link")).unwrap();
}

#[test]
fn mistakes_are_reported_at_their_place() {
    let work = folder();
    prepare(work.path());
    let mut complaints = Vec::new();
    for (name, bytes, message) in programs() {
        let file = format!("{name}.cfg");
        fs::write(work.path().join(&file), bytes).unwrap();
        let (status, said) = bounded(&["build", &file, "--period", "1", "-o", "out"], work.path());
        let start: String = said.chars().take(600).collect();
        if status != Some(1) || !said.contains(message) || said.contains("panicked") {
            complaints.push(format!("{name}: exit {status:?}, expected {message}, found\n{start}"));
        }
        if said.len() > 200_000 || said.contains("topsecret") {
            complaints.push(format!("{name}: {} bytes of messages", said.len()));
        }
    }
    none(&complaints);
    assert!(!work.path().join("out").exists(), "something was written");
}

#[test]
fn paths_that_are_no_programs() {
    let work = folder();
    fs::create_dir(work.path().join("folder")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", work.path().join("endless.cfg")).unwrap();
    let paths = [
        ("folder", "error[P0008]"),
        ("none.cfg", "error[P0008]"),
        ("endless.cfg", "error[P0008]"),
        ("/dev/null", "error[P0008]"),
        // A file of the system has no length: it counts as empty.
        ("/proc/self/mem", "error[P0006]"),
    ];
    for (path, message) in paths {
        let (status, said) = bounded(&["check", path], work.path());
        assert_eq!(status, Some(1), "{path}: {said}");
        assert!(said.contains(message), "{path}: {said}");
    }
}

#[test]
fn odd_text_that_is_fine() {
    let work = folder();
    let programs: [(&str, &[u8]); 5] = [
        ("korean", b"! \xc1\xa6\xbe\xee\nCONTROL\n1 x = msc ( : 1. ) ! \xb0\xaa\nEND\n"),
        ("after_end", b"CONTROL\n1 x = msc ( : 1. )\nEND\n\x00\xff\xfe ( ( ( 1 = 1 = \x80"),
        ("mark", b"\xef\xbb\xbfCONTROL\n1 x = msc ( : 1. )\nEND"),
        ("lines", b"CONTROL\r\n1 x = msc ( :\r\n 1. )\rEND\r"),
        ("tabs", b"\tCONTROL\n1\tx\t=\tmsc\t(\t:\t1.\t)\nEND\n"),
    ];
    for (name, bytes) in programs {
        let file = format!("{name}.cfg");
        fs::write(work.path().join(&file), bytes).unwrap();
        let (status, said) = bounded(&["check", "--strict", &file], work.path());
        assert_eq!((status, said.as_str()), (Some(0), ""), "{name}");
    }
}

#[test]
fn an_output_that_cannot_be_written_fails_without_a_trace_of_it() {
    let work = folder();
    fs::write(work.path().join("x.cfg"), "CONTROL\n1 x = msc ( : 1. )\nEND\n").unwrap();
    fs::write(work.path().join("taken"), "mine").unwrap();
    let (status, said) = bounded(&["build", "x.cfg", "-o", "taken"], work.path());
    assert_eq!(status, Some(3), "{said}");
    assert!(said.contains("taken"), "{said}");
    assert_eq!(fs::read_to_string(work.path().join("taken")).unwrap(), "mine");
    let (status, _) = bounded(&["build", "x.cfg", "-o", "out", "--target", "abacus"], work.path());
    assert_eq!(status, Some(2));
    assert!(!work.path().join("out").exists());
}

/// A net in PNML is no program: each command that reads one says so, and which commands read PNML.
#[test]
fn a_net_in_pnml_is_refused_with_what_to_do() {
    let work = folder();
    let text = "<?xml version=\"1.0\"?>\n<pnml><net id=\"n\"/></pnml>\n";
    fs::write(work.path().join("n.pnml"), text).unwrap();
    fs::write(work.path().join("empty.pnml"), "").unwrap();
    fs::write(work.path().join("n.cfg"), format!("\u{feff}\n  {text}")).unwrap();
    fs::create_dir(work.path().join("project")).unwrap();
    fs::write(work.path().join("project/pcl2.toml"), "[controller]\nsource = \"n.pnml\"\n").unwrap();
    fs::write(work.path().join("project/n.pnml"), text).unwrap();
    for path in ["n.pnml", "empty.pnml", "n.cfg", "project"] {
        for command in ["check", "build -o out", "run", "fmt", "params", "net report -o out"] {
            let args: Vec<&str> = command.split(' ').chain([path]).collect();
            let (status, said) = bounded(&args, work.path());
            assert_eq!(status, Some(1), "{args:?}: {said}");
            assert_eq!(
                said.matches("error[P0008]: expected a .cfg or .net file, found `").count(),
                1,
                "{args:?}: {said}"
            );
            assert_eq!(said.matches("error").count(), 1, "{args:?}: {said}");
            assert!(
                said.contains("is for `pcl2 graph` and `pcl2 net`: analyze, matrix, fire, export"),
                "{args:?}: {said}"
            );
            assert!(path != "project" || said.contains("pcl2.toml:2:10"), "{said}");
        }
    }
    assert!(!work.path().join("out").exists());
}

/// An answer that does not reach standard output is a failure, whatever the command.
#[test]
fn a_full_disk_is_told_by_all_commands() {
    let work = folder();
    fs::write(work.path().join("x.cfg"), "CONTROL\n1 x = msc ( : 1. )\nEND\n").unwrap();
    fs::write(work.path().join("bad.cfg"), "CONTROL\n1 x = mcs ( : 1. )\nEND\n").unwrap();
    fs::write(work.path().join("x.txt"), "x.value=2.\n").unwrap();
    let commands = [
        "--help",
        "--version",
        "run --help",
        "blocks",
        "blocks msc",
        "explain P0101",
        "check -v x.cfg",
        "check --format json bad.cfg",
        "build x.cfg -o out",
        "build x.cfg -o out --emit amalgamation",
        "run x.cfg --period 1 --steps 3",
        "run x.cfg --period 1 --steps 3 --trace -",
        "run x.cfg --period 1 --steps 3 --plot -",
        "run x.cfg --period 1 --steps 3 --params -",
        "params x.cfg",
        "params x.cfg --from x.txt --diff",
        "params x.cfg --from x.txt --save",
        "graph x.cfg -o -",
        "new project",
    ];
    for command in commands {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = pcl2().args(command.split(' ')).current_dir(work.path()).stdout(full).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{command}: {said}");
        assert!(said.contains("error: cannot write "), "{command}: {said}");
    }
    // What nobody could see is not written into the source.
    assert!(fs::read_to_string(work.path().join("x.cfg")).unwrap().contains(": 1. )"));
}
