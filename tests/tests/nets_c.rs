//! The C of nets: names that meet, functions that nobody calls, and what random nets do not have.

use pcl2_tests::compilers::{Built, STRICT, check};
use pcl2_tests::definition::text;
use pcl2_tests::dice::Dice;
use pcl2_tests::fences::fences;
use pcl2_tests::nets::{self, column};
use pcl2_tests::random_nets::{self, Wanted};
use pcl2_tests::{pcl2, root, run};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// What stands behind the name of a net in the C of both forms.
const BEHIND: &str = "act active after boxes calm check commit drives duration empty enter excite force force_put \
                      force_take gates gates_1 hands hold init inputs leave levels mode net obey outputs pass \
                      places put record scan swap table take there touch try tune vacant vacant_but_exit wait wake words writes";

fn write(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        fs::write(folder.join(name), text).unwrap();
    }
}

/// Builds a program in both forms; compilers have nothing to say about it.
fn compile(files: &[(&str, &str)]) {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), files);
    for form in ["fast", "table"] {
        let mut built = Built::empty();
        let program = folder.path().join(files[0].0);
        let mut command = pcl2();
        command.arg("build").arg(program).arg("--blocks").arg(folder.path());
        command.args(["--period", "0.5", "--net-form", form, "-o"]).arg(built.path());
        built.said = check(&mut command);
        built.counts_bytes();
        for compiler in ["gcc", "clang"] {
            built.compile(compiler, &STRICT);
        }
    }
}

/// The trace that all engines and forms give.
fn traced(net: &str, steps: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[("n.net", net)]);
    let trace = |more: &[&str]| {
        let mut command = pcl2();
        command
            .arg("run")
            .arg(folder.path().join("n.net"))
            .args(["--trace", "-", "--period", "1", "--steps", steps])
            .args(more);
        let output = run(&mut command);
        assert!(output.status.success(), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let embedded = trace(&[]);
    for form in ["fast", "table"] {
        assert_eq!(trace(&["--engine", "cc", "--net-form", form]), embedded, "{form}");
    }
    embedded
}

/// A net with a box called like each function that is made of it.
fn crowded() -> String {
    let names: Vec<&str> = BEHIND.split_whitespace().collect();
    let mut text =
        "int y, real since = n ( int x, int changed, int nets : )\nACTIVE y, since OF tune, init\n".to_owned();
    for name in &names {
        let kind = if *name == "wait" { "TIME wait 0.5" } else { &format!("STATE {name}") };
        let _ = writeln!(text, "{kind}{}", if *name == "act" { " MARKED" } else { "" });
    }
    for (from, to) in names.iter().zip(names.iter().cycle().skip(1)) {
        let _ = writeln!(text, "GATE {from} : {from} -> {to} IF changed");
    }
    text + "END\n"
}

/// The same under an operator, with tokens that carry something.
fn crowded_and_operated() -> String {
    let names: Vec<&str> = BEHIND.split_whitespace().collect();
    let mut text = "int y, int why = crowd ( int x, int m, cell int go = 0, cell int fire = 0, cell int put = 0, cell int take = 0 : )\n\
                    MODE m, go, fire, put, take\nBLOCKED why\nSTOP y = HOLD\nCLASS new ( int self = 1, real register = 2. )\n"
        .to_owned();
    for name in names.iter().filter(|name| !["put", "take"].contains(name)) {
        let marked = if *name == "act" { " MARKED ( self = 3 ) DRIVES y" } else { "" };
        let _ = writeln!(text, "CAPACITY {name} OF new SIZE 2 ORDER least self{marked}");
    }
    let boxes: Vec<&&str> = names.iter().filter(|name| !["put", "take"].contains(name)).collect();
    for (from, to) in boxes.iter().zip(boxes.iter().cycle().skip(1)) {
        let _ = writeln!(text, "GATE {from} : {from} -> {to} PERMIT x, {to}.register < 3. IF {from}.self > 0");
    }
    text + "END\n"
}

#[test]
fn boxes_and_nets_may_be_called_like_what_is_made_of_a_net() {
    let small = |name: &str| {
        format!(
            "int y = {name} ( int changed : )\nSTATE a MARKED\nSTATE b DRIVES y\nGATE g : a -> b IF changed\n\
             GATE h : b -> a IF NOT changed\nEND\n"
        )
    };
    let (gates, take) = (small("n_gates"), small("n_take"));
    let main = "CONTROL\n1 x = msi ( : 1 )\n2 N = n ( x, x, x : )\n3 n_gates = n_gates ( x : )\n4 T = n_take ( x : )\n\
                5 C = n_init ( x : )\nEND\n";
    let composite = "int y = n_init ( int changed : )\nBODY\n1 z = n_gates ( changed : )\n2 y = not ( z : )\nEND\n";
    let files = [
        ("main.cfg", main),
        ("n_init.fc", composite),
        ("n.net", &crowded()),
        ("n_gates.net", &gates),
        ("n_take.net", &take),
    ];
    compile(&files);
    compile(&[("crowd.net", &crowded_and_operated())]);
}

/// The page shows the code of a gate as it is.
#[test]
fn the_page_shows_code_that_is_written() {
    let page = fs::read_to_string(root().join("docs/nets.md")).unwrap();
    let blocks = fences(&page);
    let shown = blocks.iter().find(|block| block.language == "c").unwrap();
    let net = blocks.iter().find(|block| block.file.as_deref() == Some("fill.net")).unwrap();
    let (folder, built) = (tempfile::tempdir().unwrap(), Built::empty());
    write(folder.path(), &[("fill.net", &net.text)]);
    let mut command = pcl2();
    check(command.arg("build").arg(folder.path().join("fill.net")).args(["--period", "0.5", "-o"]).arg(built.path()));
    let code = fs::read_to_string(built.path().join("fill.c")).unwrap();
    let lines = |text: &str| text.lines().map(|line| line.trim().to_owned()).collect::<Vec<_>>().join("\n");
    assert!(lines(&code).contains(&lines(&shown.text)), "{code}");
}

/// A program may be called like a variable of the functions that are made of it.
#[test]
fn programs_may_be_called_like_variables() {
    for name in ["n", "self", "ready", "scan", "controller", "order", "box", "x"] {
        let inner = followers("inner", &["int"]);
        let main = "CONTROL\n1 x = msi ( : 1 )\n2 q = inner ( x : )\nEND\n";
        compile(&[(&format!("{name}.cfg"), main), ("inner.net", &inner)]);
    }
}

/// The bytes of an instance are told exactly, in both forms: offsets in tables are as wide as they ask for.
#[test]
fn bytes_of_an_instance_are_counted_as_c_counts_them() {
    let mut dice = random_nets::dice(3);
    for i in 0..40 {
        let wanted = Wanted { classes: i % 2 == 1, modes: true, calm: false };
        let name = format!("r{i}");
        let net = random_nets::net(&mut dice, &name, wanted);
        let folder = tempfile::tempdir().unwrap();
        for (file, text) in text::files(&net) {
            fs::write(folder.path().join(file), text).unwrap();
        }
        for form in ["fast", "table"] {
            let mut built = Built::empty();
            let mut command = pcl2();
            command.arg("build").arg(folder.path().join(format!("{name}.net")));
            command.args(["--period", "0.5", "--net-form", form, "-o"]).arg(built.path());
            built.said = check(&mut command);
            built.counts_bytes();
        }
    }
}

#[test]
fn functions_that_nobody_calls_are_not_written() {
    // A class whose name begins with that of another, of which nothing new is made; a command and nothing to force.
    let classes = "int y = classes ( int x : )\nCLASS job ( int a = 3 )\nCLASS job2 ( int a = 3 )\n\
                   STATE p OF job MARKED\nSTATE q OF job\nSTATE r OF job2\nSTATE s MARKED\nSTATE t OF job2 DRIVES y\n\
                   GATE g : p -> q IF x\nGATE h : s -> r\nTHEN s -> nothing\nTHEN NEW -> r\nGATE i : r -> t\nEND\n";
    compile(&[("classes.net", classes)]);
    let worked = "int z = worked ( int x, int mode, int put, int fire, int take : )\n\
                  MACRO M : z = inner ( mode, , fire, put, take : )\nSTATE a MARKED\nGATE g : a -> M\nEND\n";
    let inner = "int z = inner ( int m, cell int go = 0, cell int fire = 0, cell int put = 0, cell int take = 0 : )\n\
                 MODE m, go, fire, put, take\nENTRY e\nEXIT y DRIVES z\nGATE g : e -> y\nEND\n";
    compile(&[("worked.net", worked), ("inner.net", inner)]);
    let still = "int y = still ( : )\nSTATE a MARKED DRIVES y\nEND\n";
    compile(&[("still.net", still)]);
    let outer = "int y = outer ( int x : )\nSTATE a MARKED DRIVES y\nMACRO unused = inner ( : )\nMACRO M = middle ( : )\n\
                 GATE g : a -> M IF x\nGATE h : M -> a\nEND\n";
    let middle = "= middle ( : )\nENTRY a\nEXIT b\nMACRO I = innermost ( : )\nGATE g : a -> I\nGATE h : I -> b\nEND\n";
    let inner = |name: &str| format!("= {name} ( : )\nENTRY a\nEXIT b\nGATE g : a -> b\nEND\n");
    let aborting = outer.replace("middle ( : )\n", "middle ( : )\nABORT NOT x -> a\n");
    for text in [outer, &aborting] {
        let (inner, innermost) = (inner("inner"), inner("innermost"));
        compile(&[("outer.net", text), ("middle.net", middle), ("inner.net", &inner), ("innermost.net", &innermost)]);
    }
}

/// What a permissive computes on its way is there once, however many rules the gate has.
#[test]
fn a_permissive_that_computes_stands_before_several_rules() {
    let net = "int y = n ( real v, int x : )\nSTATE a MARKED\nSTATE b DRIVES y\n\
               GATE g : a -> b PERMIT 1./(v + 0.8) > 1.\nIF x\nTHEN a -> b\nIF v*2. > -1.\nTHEN a -> b\nEND\n";
    let trace = traced(net, "2");
    assert_eq!(trace.lines().nth(1).unwrap(), "0,0,0.0,0,1,0,1");
}

/// Tokens of a box without a limit stop at the largest int, also where two gates put them in one scan.
#[test]
fn tokens_without_a_limit_do_not_wrap() {
    let net = "= n ( : )\nCAPACITY a\nGATE g : -> 2147483647*a\nGATE h : -> 2147483647*a\nEND\n";
    assert!(traced(net, "2").ends_with("1,1,2147483647\n"));
}

/// What stands in the vector of a net's tokens is told by name.
#[test]
fn boxes_are_named_in_the_model_description() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.net");
    std::fs::write(&path, "= two ( : )\nSTATE a MARKED\nSTATE b\nGATE g : a -> b\nEND\n").unwrap();
    let output = run(pcl2().arg("build").arg(&path).arg("-o").arg(folder.path().join("out")));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(folder.path().join("out/two.json")).unwrap();
    let model: serde_json::Value = serde_json::from_str(&text).unwrap();
    let signals = model["signals"].as_array().unwrap();
    let tokens = signals.iter().find(|signal| signal["name"] == "two.box").unwrap();
    assert_eq!(tokens["elements"], serde_json::json!(["a", "b"]));
}

/// An output that a gate asks for is as the last scan left it until the phase ends.
#[test]
fn gates_see_outputs_as_the_last_scan_left_them() {
    let net = "int y, int z = n ( int x : )\nSTATE a MARKED\nSTATE b DRIVES y\nSTATE c MARKED\nSTATE d DRIVES z\n\
               GATE g : a -> b IF x\nGATE h : c -> d IF y\nGATE i : b -> a IF NOT x\nGATE j : d -> c IF NOT y\nEND\n";
    let trace = nets::traced(&[("n.net", net)], "k,x\n0,0\n2,1\n5,0\n", &["--steps", "8"]);
    assert_eq!(column(&trace, "y"), [0., 0., 1., 1., 1., 0., 0., 0.]);
    assert_eq!(column(&trace, "z"), [0., 0., 0., 1., 1., 1., 0., 0.]);
}

/// A token that was taken at once no room for a later gate of the scan: in a full ring nothing else moves.
#[test]
fn a_token_taken_at_once_leaves_no_room_in_the_scan() {
    let net = "= n ( int x : )\nSTATE a MARKED\nSTATE b\nSTATE c MARKED\n\
               GATE g : a -> b IF x\nGATE h : c -> a\nGATE i : b -> c\nEND\n";
    let trace = nets::traced(&[("n.net", net)], "k,x\n0,1\n", &["--steps", "4"]);
    assert_eq!(column(&trace, "n.a"), [0., 1., 1., 0.]);
    assert_eq!(column(&trace, "n.b"), [1., 1., 0., 1.]);
    assert_eq!(column(&trace, "n.c"), [1., 0., 1., 1.]);
}

/// A pair of states for each input: the output is 1 exactly while the input is not 0.
fn followers(name: &str, inputs: &[&str]) -> String {
    let outputs: Vec<String> = (0..inputs.len()).map(|i| format!("int y{i}")).collect();
    let ports: Vec<String> = inputs.iter().enumerate().map(|(i, ty)| format!("{ty} x{i}")).collect();
    let mut text = format!("{} = {name} ( {} : )\n", outputs.join(", "), ports.join(", "));
    for (i, ty) in inputs.iter().enumerate() {
        let on = if *ty == "real" { format!("x{i}*x{i} > 0.") } else { format!("x{i}") };
        let off = if *ty == "real" { format!("x{i}*x{i} <= 0.") } else { format!("NOT x{i}") };
        let _ = writeln!(text, "STATE off{i} MARKED\nSTATE on{i} DRIVES y{i}");
        let _ = writeln!(text, "GATE g{i} : off{i} -> on{i} IF {on}\nGATE h{i} : on{i} -> off{i} IF {off}");
    }
    text + "END\n"
}

/// Values for so many inputs, by scan: few change, and not all of those from or to 0.
fn changes(inputs: usize, scans: usize) -> Vec<Vec<i32>> {
    let mut dice = Dice(7);
    let mut now = vec![0; inputs];
    let mut all = Vec::new();
    for _ in 0..scans {
        for value in &mut now {
            if dice.once_in(9) {
                *value = [0, 0, 1, 2, -1, i32::MIN][dice.below(6)];
            }
        }
        all.push(now.clone());
    }
    all
}

fn stimulus(names: &[String], values: &[Vec<i32>]) -> String {
    let mut text = format!("k,{}\n", names.join(","));
    for (k, row) in values.iter().enumerate() {
        let row: Vec<String> = row.iter().map(i32::to_string).collect();
        let _ = writeln!(text, "{k},{}", row.join(","));
    }
    text
}

fn assert_follows(output: &[f64], values: &[Vec<i32>], input: usize) {
    let expected: Vec<f64> = values.iter().map(|row| f64::from(row[input] != 0)).collect();
    assert_eq!(output, expected, "input {input}");
}

/// Inputs of a net that is the program are compared side by side, as far as they are ints in a row.
#[test]
fn changes_of_inputs_side_by_side_are_seen() {
    let inputs = ["int", "int", "real", "int", "int", "int", "real", "int", "int", "int", "int", "int", "int", "int"];
    let values = changes(inputs.len(), 400);
    let names: Vec<String> = (0..inputs.len()).map(|i| format!("x{i}")).collect();
    let text = followers("many", &inputs);
    compile(&[("many.net", &text)]);
    let trace = nets::traced(&[("many.net", &text)], &stimulus(&names, &values), &["--steps", "400"]);
    for i in 0..inputs.len() {
        assert_follows(column(&trace, &format!("y{i}")), &values, i);
    }
}

/// Many instances of one net share the function that takes their inputs in, also in parts of a long section.
#[test]
fn instances_of_a_net_take_their_own_inputs() {
    let values = changes(3, 200);
    let mut program = "CONTROL\n1 x0 = msi ( : 0 )\n2 x1 = msi ( : 0 )\n3 x2 = msi ( : 0 )\n".to_owned();
    for i in 0..70 {
        let [a, b] = [i % 3, (i + 1 + i / 35) % 3];
        let _ = writeln!(program, "{} a{i}, b{i} = pair ( x{a}, x{b} : )", 10 + 2 * i);
    }
    program.push_str("END\n");
    let files = [("main.cfg", program.as_str()), ("pair.net", &followers("pair", &["int", "int"]))];
    let names: Vec<String> = (0..3).map(|i| format!("x{i}.value")).collect();
    let trace = nets::traced(&files, &stimulus(&names, &values), &["--steps", "200"]);
    for i in 0..70 {
        assert_follows(column(&trace, &format!("a{i}")), &values, i % 3);
        assert_follows(column(&trace, &format!("b{i}")), &values, (i + 1 + i / 35) % 3);
    }
}
