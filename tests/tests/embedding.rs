//! The generated C in a program of its user's.

use pcl2_tests::cases::{self, Width};
use pcl2_tests::compilers::{self, Built, STRICT, alone, check};
use pcl2_tests::{none, pcl2, root, run};
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn instances_of_one_program_do_not_touch_each_other() {
    let built = alone(&cases::find("paper_gpc"), Width::F64);
    let program = built.path().join("instances");
    built.link(&root().join("tests/c/instances.c"), &["-std=c99", "-O2", "-ffp-contract=off"], &program);
    check(&mut Command::new(&program));
}

/// The example is the only file with a `main`, and the Makefile builds it.
#[test]
fn the_example_program_runs_as_the_makefile_builds_it() {
    for case in ["gpc_closed_loop", "long_program", "names_clash", "rates", "user_block", "operator_cells"] {
        let built = alone(&cases::find(case), Width::F64);
        let mains = built.sources().into_iter().filter(|path| fs::read_to_string(path).unwrap().contains("int main("));
        let mains: Vec<String> = mains.map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect();
        assert!(mains.len() == 1 && mains[0].ends_with("_example.c"), "{case}: {mains:?}");
        check(Command::new("make").arg("-C").arg(built.path()).args(["-s", "CFLAGS=-O1 -fsanitize=address,undefined"]));
        check(&mut Command::new(built.path().join(mains[0].trim_end_matches(".c"))));
    }
}

#[test]
fn every_form_of_build_works() {
    let case = cases::find("gpc_closed_loop");
    for (emit, file) in [("obj", "gpc_closed_loop.o"), ("lib", "libgpc_closed_loop.a"), ("exe", "gpc_closed_loop")] {
        let built = Built::empty();
        check(case.command("build").args(["--emit", emit, "-o"]).arg(built.path()));
        assert!(built.path().join(file).is_file(), "{emit}");
        if emit == "exe" {
            check(&mut Command::new(built.path().join(file)));
        }
    }
}

#[test]
fn an_amalgamation_is_one_header_and_one_c_file() {
    for name in ["gpc_closed_loop", "long_program", "composite_many", "user_block", "float_lags"] {
        let built = Built::empty();
        check(cases::find(name).command("build").args(["--emit", "amalgamation", "-o"]).arg(built.path()));
        let main = built.path().join(format!("{name}.c"));
        for compiler in ["gcc", "clang"] {
            let mut compile = Command::new(compiler);
            check(compile.args(STRICT).arg("-c").arg(&main).arg("-o").arg(built.path().join("a.o")));
        }
        assert_eq!(compilers::files(built.path(), "h").len(), 1);
        let program = built.path().join("program");
        let example = built.path().join(format!("{name}_example.c"));
        check(Command::new("gcc").arg("-o").arg(&program).args([&main, &example]));
        check(&mut Command::new(&program));
    }
}

#[test]
fn programs_share_one_runtime_folder() {
    let built = Built::empty();
    let paths = ["rates", "long_program", "first_lags"].map(|name| cases::find(name).path());
    check(pcl2().arg("build").args(paths).arg("-o").arg(built.path()));
    let object = built.compile("gcc", &STRICT);
    assert_eq!(compilers::files(object.path(), "o").len(), built.sources().len());
    check(Command::new("make").arg("-C").arg(built.path()).arg("-s"));
    for program in ["rates", "long_program", "first_lags"] {
        check(&mut Command::new(built.path().join(format!("{program}_example"))));
    }
    let twice =
        run(pcl2().arg("build").args([cases::find("rates").path(), cases::find("rates").path()]).arg("-o").arg("x"));
    assert_eq!(twice.status.code(), Some(2));
}

const C_HEADERS: [&str; 24] = [
    "assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits", "locale", "math", "setjmp",
    "signal", "stdarg", "stdbool", "stddef", "stdint", "stdio", "stdlib", "string", "tgmath", "time", "wchar",
    "wctype",
];

/// After every header of C, with the extensions of GNU C, the names of a program are still names; in C++ too.
#[test]
fn names_of_the_user_meet_no_macro_and_no_keyword() {
    let built = alone(&cases::find("names_clash"), Width::F64);
    let headers: String = C_HEADERS.iter().map(|name| format!("#include <{name}.h>\n")).collect();
    let text = |headers: &str| format!("{headers}#include \"main_.h\"\nmain_ instance;\n");
    let plus: String = C_HEADERS
        .iter()
        .filter(|name| !["complex", "tgmath", "stdbool", "iso646"].contains(name))
        .map(|name| format!("#include <{name}.h>\n"))
        .collect();
    let runs: [(&str, &[&str], String); 4] = [
        ("gcc", &["-std=gnu11", "-D_GNU_SOURCE", "-x", "c"], text(&headers)),
        ("gcc", &["-std=c99", "-x", "c"], text(&headers)),
        ("clang", &["-std=gnu17", "-D_GNU_SOURCE", "-x", "c"], text(&headers)),
        ("gcc", &["-std=c++17", "-x", "c++", "-fsyntax-only"], text(&plus)),
    ];
    for (compiler, flags, text) in runs {
        let path = built.path().join("user.txt");
        fs::write(&path, text).unwrap();
        let mut command = Command::new(compiler);
        command.args(flags).args(["-O2", "-Wall", "-Werror", "-c", "-o"]).arg(built.path().join("user.o"));
        for include in built.includes() {
            command.arg("-I").arg(include);
        }
        check(command.arg(&path));
    }
}

/// The text without comments; neither string nor character constants have any in them.
fn without_comments(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(start) = rest.find("/*") {
        plain.push_str(&rest[..start]);
        let end = rest[start..].find("*/").expect("an open comment");
        rest = &rest[start + end + 2..];
    }
    plain + rest
}

const TEXTS: [&[u8]; 12] = [
    b"plain",
    b"*/ int x; /*",
    b"/* never closed",
    b"// slashes",
    b"a backslash at the end \\",
    b"trigraphs ??/ ??' ??( *??/\n",
    b"%s %n \"quotes' # #include <no.h>",
    b"\xb0\xa1\xb3\xaa Korean in EUC-KR",
    b"\x83\x5c Shift-JIS with a backslash inside \x83\x5c",
    b"\xff\xfe\x00\x01 bytes",
    b"*\\",
    b"??/",
];

fn program(text: &[u8]) -> Vec<u8> {
    let mut program = b"CONTROL ! ".to_vec();
    let lines: [&[u8]; 4] = [b"1 x = msc ( : 1. ) ! ", b"2 y = first ( x : 1., ! ", b" 2., ) ! ", b"END ! "];
    for line in lines {
        program.extend(text.iter().filter(|byte| **byte != b'\n'));
        program.push(b'\n');
        program.extend(line);
    }
    program.extend(text);
    program
}

#[test]
fn comments_never_change_the_c() {
    let mut expected: Option<String> = None;
    let mut complaints = Vec::new();
    for text in TEXTS {
        let built = Built::empty();
        fs::write(built.path().join("level.cfg"), program(text)).unwrap();
        let mut build = pcl2();
        build.arg("build").arg(built.path().join("level.cfg")).args(["--period", "1", "-o"]).arg(built.path());
        check(&mut build);
        built.compile("gcc", &[&STRICT[..], &["-trigraphs"]].concat());
        let c = ["level.h", "level.c", "level_map.c"].map(|name| fs::read(built.path().join(name)).unwrap()).concat();
        let c = without_comments(&String::from_utf8(c).expect("text"));
        match &expected {
            None => expected = Some(c),
            Some(expected) if *expected == c => {}
            Some(_) => complaints.push(String::from_utf8_lossy(text).into_owned()),
        }
    }
    none(&complaints);
}

/// A string of the source stands in the C as a comment too.
#[test]
fn strings_never_change_the_c() {
    for folder in ["x*", "x??", "x\\", "??(", "x%n"] {
        let built = Built::empty();
        fs::create_dir_all(built.path().join(folder)).unwrap();
        fs::write(built.path().join(folder).join("v.txt"), "1., 2.\n").unwrap();
        let source = format!("CONTROL\n1 v = setvec ( 2 : \"{folder}/v.txt\" )\nEND\n");
        fs::write(built.path().join("level.cfg"), source).unwrap();
        check(pcl2().arg("build").arg(built.path().join("level.cfg")).arg("-o").arg(built.path()));
        built.compile("gcc", &[&STRICT[..], &["-trigraphs"]].concat());
        assert_same_value(built.path());
    }
}

fn assert_same_value(folder: &Path) {
    let mut command = pcl2();
    command.arg("run").arg(folder.join("level.cfg")).args(["--steps", "1", "--engine", "cc", "--trace", "-"]);
    assert_eq!(check(&mut command), "@k,@t,v[1],v[2]\n0,,1.0,2.0\n");
}
