//! Nets with mistakes: each is told, once, at its place.

use pcl2_tests::nets::checked;
use pcl2_tests::{pcl2, run};

fn refused(text: &str, code: &str) {
    let (status, shown) = checked(text);
    assert_eq!(status, Some(1), "{text}\n{shown}");
    assert!(shown.contains(code), "{code} for\n{text}\nfound\n{shown}");
}

/// What is wrong in a net is told at its place, and nothing runs.
#[test]
fn nets_with_mistakes_are_refused() {
    let head = "= bad ( int x : )\n";
    let cases = [
        ("STATE a MARKED\nGATE g : a -> b\nEND\n", "P0401"),
        ("STATE a\nSTATE a\nEND\n", "P0402"),
        ("CAPACITY a SIZE 2 MARKED 3\nEND\n", "P0404"),
        ("MACRO m = bad ( x : )\nEND\n", "P0406"),
        ("STATE a SIZE 3\nEND\n", "P0408"),
        ("STATE a MARKED\nGATE g : a -> IF 1.5\nEND\n", "P0409"),
        ("CLASS c ( int n )\nSTATE a OF c\nSTATE b\nGATE g : b -> a\nEND\n", "P0405"),
        ("STATE a MARKED\n", "P0006"),
        ("OPERATION o DO nobody ( x : )\nEND\n", "P0101"),
        ("GATE g : a ->\nTHEN\nEND\n", "P0002"),
        ("END\n", "P0408"),
        ("STATE a\nSTATE b MARKED\nSTATE c\nGATE g : b -> a, c\nTHEN b -> a\nEND\n", "P0403"),
        ("STATE a\nFOR i = 1 TO 2000000000\nNEXT\nEND\n", "P0208"),
        ("STATE a\nFOR i = 1 TO 2000000000\nFOR j = 1 TO 2000000000\nNEXT\nNEXT\nEND\n", "P0208"),
        ("CLASS c ( int n )\nFOR i = 1 TO 1000\nCAPACITY a[i] OF c SIZE 65535\nNEXT\nEND\n", "P0208"),
        ("MODE y\nSTATE a\nEND\n", "P0408"),
        ("MODE x\nMODE x\nSTATE a\nEND\n", "P0408"),
        ("MODE x, x\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nMODE x\nSTOP l = 0\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nSTOP l = 0\nSTATE a\nEND\n", "P0408"),
        ("MODE x\nSTOP nobody = HOLD\nSTATE a\nEND\n", "P0401"),
        ("LOCAL real l\nBLOCKED l\nSTATE a\nEND\n", "P0203"),
        ("LOCAL int l\nBLOCKED l\nBLOCKED l\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nBLOCKED l\nOPERATION a DO l = 1\nEND\n", "P0407"),
        ("BLOCKED x\nSTATE a\nEND\n", "P0401"),
        ("MODE\nSTATE a\nEND\n", "P0002"),
        ("STOP l = a\nSTATE a\nEND\n", "P0002"),
    ];
    for (text, code) in cases {
        refused(&format!("{head}{text}"), code);
    }
}

/// Of a line that cannot be read nothing follows: no boxes that nobody declared, no lines that belong to nothing.
#[test]
fn a_line_that_cannot_be_read_is_all_that_is_told() {
    let head = "int y = bad ( int x : )\nSTATE a MARKED\nSTATE b DRIVES y\n";
    let cases = [
        ("GATE g a -> b\nIF x\nTHEN a -> b\nDO y = 1\n", "a gate is `GATE name : before, .. -> after, .."),
        ("GATE g : a => b\n", "a gate is `GATE name : before, .. -> after, .."),
        ("GATE g : a -> b IF x = 1\n", "a comparison for equality is `==`"),
        ("GATE g : a -> b\nIF\n", "a rule begins with `IF condition`"),
        ("PROCES c UNTIL x\nDO x = 1\nAFTER x = 0\nGATE g : a -> c\n", "did you mean `PROCESS`?"),
        ("12 b\n", "such as STATE, TIME, GATE, IF or DO"),
        ("STATE\nGATE g : a -> c\n", "a box is `STATE name"),
        ("SIGNAL c DO x := 1\n", "a box is `SIGNAL name"),
        ("MACRO m f ( x : )\nABORT x -> a\nGATE g : a -> m\n", "a net inside is `MACRO name : outputs = net"),
        ("\u{a7}\nDO y = 1\n", "outside comments only ASCII letters"),
        ("LOCAL n\nSIGNAL c DO n = 1\n", "such a line is `LOCAL int n = 0, real x`"),
    ];
    for (lines, help) in cases {
        let (status, shown) = checked(&format!("{head}{lines}END\n"));
        assert_eq!(status, Some(1), "{lines}\n{shown}");
        assert!(shown.contains(help) && shown.matches("error[").count() == 1, "{lines}\n{shown}");
    }
    for head in ["int y = bad ( int x )\n", "y = bad ( int x : )\n"] {
        let (_, shown) = checked(&format!("{head}STATE a MARKED\nEND\n"));
        assert!(shown.contains("a head is `type output, .. = name ("), "{shown}");
        assert_eq!(shown.matches("error[").count(), 1, "{shown}");
    }
}

/// Independent mistakes are told together, and none only because of another one.
#[test]
fn mistakes_are_told_together_and_nothing_that_follows() {
    let head = "int y = bad ( int x, cell int mode = 0 : )\nCLASS part ( int kind )\nSTATE a MARKED\n";
    let cases: [(&str, &[&str]); 18] = [
        ("STATE b MARKED 2 DRIVES y\nGATE g : a -> b IF xx\n", &["P0404", "found `xx`", "did you mean `x`?"]),
        ("STATE b DRIVES y\nGATE g : a -> b IF c.k\nGATE h : b -> a IF z\n", &["found `c`", "found `z`"]),
        ("STATE b OF part DRIVES y\nGATE g : b -> IF b.color == 1\n", &["found `color`", "the attributes are kind"]),
        ("STATE b DRIVES y\nGATE g : b -> IF b.color\n", &["found `color`", "its tokens are plain"]),
        ("PROCESS b UNTIL x DRIVES y\nGATE g : b -> IF b.cause\n", &["only a PROCESS with AFTER has a cause"]),
        ("PROCESS b UNTIL x DRIVES y\nAFTER b.cause = 0\n", &["the cause of a process is read only"]),
        ("STATE b OF part MARKED ( kind = 1, kind = 2 ) DRIVES y\n", &["expected each attribute once"]),
        ("TIME b a DRIVES y\n", &["expected a time in seconds, found the box `a`"]),
        ("TIME b -3. DRIVES y\n", &["expected a time from 0, found `-3.`"]),
        ("STATE b DRIVES y\nGATE g : b -> READ 2*a\n", &["expected at most 1 token in `a`, found 2"]),
        ("STATE b DRIVES yy\n", &["found `yy`"]),
        ("CAPACITY b SIZE 0 MARKED DRIVES y\nGATE g : b ->\n", &["expected a size from 1 to 65535, found 0"]),
        ("CAPACITY b SIZE 99999999999 DRIVES y\nGATE g : b ->\n", &["P0004"]),
        ("CAPACITY b OF pert SIZE 2 ORDER least due DRIVES y\nSTATE c OF part\nGATE g : b -> c\n", &["found `pert`"]),
        ("COUNT b 3 OF part DRIVES y\nSTATE c OF part\nGATE g : c -> b\n", &["tokens of a COUNT box are plain"]),
        ("STATE b OF part DRIVES y\nGATE g : a -> b IF x\n", &["bad.net:5:15", "found a plain one before the gate"]),
        ("LOCAL int s\nACTIVE s OF a, a\nSTATE b DRIVES y\n", &["expected each box once, found `a` again"]),
        ("MODE mod\nSTATE b DRIVES y\n", &["found `mod`", "did you mean `mode`?"]),
    ];
    for (lines, told) in cases {
        let (status, shown) = checked(&format!("{head}{lines}END\n"));
        assert_eq!(status, Some(1), "{lines}\n{shown}");
        told.iter().for_each(|told| assert!(shown.contains(told), "{told} for\n{lines}\n{shown}"));
        let errors = 1 + usize::from(lines.contains("xx") || lines.contains("c.k"));
        assert_eq!(shown.matches("error[").count(), errors, "{lines}\n{shown}");
    }
    // What a line that cannot be read does not declare is missing all the same.
    let lines = "STATE b DRIVES y\nGATE x a -> b\nGATE g : a -> b IF zz\nTHEN NEW -> b\nCAPACITY c SIZE 0\n";
    let (_, shown) = checked(&format!("{head}{lines}END\n"));
    assert_eq!(shown.matches("error[").count(), 4, "{shown}");
    // Comments that begin so where no condition stands are comments.
    let fine = "STATE b DRIVES y != first\nTIME t 3. != seconds\nGATE g : a -> b != note\n";
    let (status, shown) = checked(&format!("{head}{fine}END\n"));
    assert_eq!(status, Some(0), "{shown}");
    let unread = "CLASS job\nCAPACITY b OF job SIZE 2 ORDER least due DRIVES y\nGATE g : b -> IF b.due > 1\n";
    let (_, shown) = checked(&format!("{head}{unread}END\n"));
    assert_eq!(shown.matches("error[").count(), 1, "{shown}");
}

/// A net that is told one thing: the code, and some words of what is shown.
fn told_once(text: &str, code: &str, words: &str) {
    let (status, shown) = checked(text);
    assert_eq!(status, Some(1), "{text}\n{shown}");
    assert_eq!(shown.matches("error[").count(), 1, "{text}\n{shown}");
    assert!(shown.contains(code) && shown.contains(words), "{code} {words} for\n{text}\nfound\n{shown}");
}

const SWITCH: &str =
    "int q = bad ( int b : )\nSTATE off MARKED\nSTATE on DRIVES q\nGATE g : off -> on IF b\nGATE h : on -> off\n";

/// `!` begins a comment: a condition that another language's signs cut short is not compiled.
#[test]
fn signs_of_other_languages_make_no_silent_comments() {
    let conditions = [
        ("b != 1", "P0011", "bad.net:4:25"),
        ("( b != 1 )", "P0011", "bad.net:4:27"),
        ("( NOT b AND\nb != 1 )", "P0011", "bad.net:5:3"),
        ("!b", "P0002", "`!` begins a comment; negation is `NOT`"),
        ("( b AND (!b) )", "P0003", "`!` begins a comment, negation is `NOT`"),
        ("b AND !b", "P0002", "`!` begins a comment; negation is `NOT`"),
    ];
    for (condition, code, words) in conditions {
        told_once(&format!("{}END\n", SWITCH.replace("IF b", &format!("IF {condition}"))), code, words);
    }
    for comment in ["! = note", "!==== note", "!b", "! != 1"] {
        let text = format!("{}END\n", SWITCH.replace("IF b", &format!("IF b {comment}")));
        assert_eq!(checked(&text), (Some(0), String::new()), "{comment}");
    }
}

/// Repeated lines are left out when it is not known how often they run.
#[test]
fn of_a_wrong_for_only_the_for_is_told() {
    let body = "CAPACITY p[i] MARKED\nCAPACITY s[i]\nGATE k[i] : p[i] -> s[i]\n";
    let cases = [
        ("FOR i = 1 TO 3", "", "P0003", "expected NEXT after FOR"),
        ("FOR i = 1, 3", "NEXT\n", "P0002", "expected `TO`, found `,`"),
        ("FOR i = 1 TO n", "NEXT\n", "P0002", "expected a number, found `n`"),
        ("FOR i = 1 TO 3 STEP 2", "NEXT\n", "P0002", "expected the end of the line, found `STEP`"),
        ("FOR i = 1.0 TO 3", "NEXT\n", "P0002", "expected an integer, found `1.0`"),
        ("FOR i = 1.0 TO 3", "", "P0002", "expected an integer, found `1.0`"),
        ("FOR i = 1 TO n\nFOR j = 1 TO 2", "NEXT\nNEXT\n", "P0002", "bad.net:6:14"),
        ("FOR i = 1 TO 2\nFOR i = 1 TO 2", "NEXT\nNEXT\n", "P0402", "bad.net:7:5"),
        ("FOR i = 2147483646 TO 2147483647\nSTATE r[i+5]", "NEXT\n", "P0004", "found 2147483651"),
    ];
    for (line, next, code, words) in cases {
        told_once(&format!("{SWITCH}{line}\n{body}{next}END\n"), code, words);
    }
}

/// Signs that look like `->`, and what Windows writes.
#[test]
fn signs_that_look_right_are_told_once() {
    for (sign, words) in [
        ("\u{2212}>", "help: type `-`"),
        ("\u{2013}>", "help: type `-`"),
        ("\u{2192}", "help: type `->`"),
        ("\u{21d2}", "help: type `->`"),
    ] {
        let text = format!("{}END\n", SWITCH.replace("off -> on", &format!("off {sign} on")));
        told_once(&text, "P0001", words);
    }
    let text = format!("{}END\n", SWITCH.replace("IF b", "IF b \u{2260} 1"));
    told_once(&text, "P0001", "help: type `<>`");
}

/// A reserved word is a bad name where a new one is due; elsewhere something is missing before it.
#[test]
fn a_reserved_word_is_a_bad_name_only_where_one_is_declared() {
    let cases = [
        ("TIME t MARKED", "P0002", "a box is `TIME name seconds"),
        ("COUNT t MARKED", "P0002", "a box is `COUNT name tokens"),
        ("ABORT IF b -> off", "P0002", "a macro is emptied by `ABORT condition -> box`"),
        ("GATE m : on -> off, IF b", "P0002", "a gate is `GATE name : before, .. -> after, .."),
        ("GATE m : on -> off READ IF b", "P0002", "a gate is `GATE name : before, .. -> after, .."),
        ("GATE m : 2.*on -> off", "P0002", "an integer"),
        ("STATE z DRIVES NOT q", "P0002", "a box is `STATE name"),
        ("MODULE m = s2 ( NOT b : )", "P0002", "found the reserved word `NOT`"),
        ("STATE MARKED", "P0106", "take another name"),
        ("LOCAL int IF", "P0106", "take another name"),
        ("FOR IF = 1 TO 2\nNEXT", "P0106", "take another name"),
    ];
    for (line, code, words) in cases {
        told_once(&format!("{SWITCH}{line}\nEND\n"), code, words);
    }
}

/// Words of clauses, a second head and a second statement have their place elsewhere.
#[test]
fn lines_that_belong_elsewhere_say_where() {
    let gate = "it stands in the line of a gate, behind the boxes";
    let cases = [
        ("PRIORITY 2", gate),
        ("PERMIT b", gate),
        ("READ off", gate),
        ("UNTIL b", "it stands in the line of a box, behind the name"),
        ("MARKED", "it stands in the line of a box, behind the name"),
        ("AND b", "a condition goes on in the next line only inside parentheses"),
        ("int r = other ( int b : )", "a net has one head, in its first line"),
        ("SIGNAL z DO n = 1 DO n = 2", "bad.net:6:19"),
        ("SIGNAL z DO n = 1 DO n = 2", "a DO has one statement: put the next one on a line of its own below"),
        ("SIGNAL z DO n = 0, n = 1", "a DO has one statement: put the next one on a line of its own below"),
        ("SIGNAL z DO n = not1 ( b : ), n = 1", "a DO has one statement"),
    ];
    for (line, words) in cases {
        told_once(&format!("{SWITCH}{line}\nEND\n"), "P0002", words);
    }
}

/// A head that is not whole hides nothing below it, and nothing follows from it.
#[test]
fn of_a_wrong_head_only_the_head_is_told() {
    let cases = [
        (SWITCH.replace("int b : )", "b : )"), "P0501", "expected a type before `b`, found none"),
        (SWITCH.replace("int b : )", "int b :"), "P0003", "bad.net:1:13"),
        (SWITCH.replace("int b : )", "int b,\nint c :"), "P0003", "bad.net:1:13"),
        (String::new(), "P0501", "expected the head of a net, found END"),
    ];
    for (lines, code, words) in cases {
        told_once(&format!("{lines}END\n"), code, words);
    }
    let (_, shown) = checked(&format!("{}GATE k a\nEND\n", SWITCH.replace("int b : )", "int b :")));
    assert!(shown.contains("P0003") && shown.contains("bad.net:6:8"), "{shown}");
}

/// A mistake in the head points at the name there; two things of one name are told once, not again where the name is
/// used; a help can be followed.
#[test]
fn a_mistake_is_told_once_at_its_place() {
    let cases = [
        ("int v, int q = bad ( : )\nSTATE a MARKED DRIVES v\nEND\n", "P0407", "bad.net:1:12"),
        ("int v, real q = bad ( : )\nSTATE a MARKED DRIVES v, q\nEND\n", "P0407", "bad.net:1:13"),
        ("int v = bad ( int v : )\nSTATE a MARKED DRIVES v\nEND\n", "P0402", "bad.net:1:5"),
        ("ivec[2] v = bad ( : )\nSTATE a MARKED\nEND\n", "P0501", "bad.net:1:9"),
        (
            "int on = bad ( int b : )\nSTATE off MARKED\nSTATE on DRIVES on\nGATE g : off -> on IF b\nGATE h : on -> off\nEND\n",
            "P0402",
            "bad.net:3:7",
        ),
        ("int box = bad ( : )\nSTATE a MARKED\nEND\n", "P0402", "bad.net:1:5"),
        ("= bad ( ivec[2] v : )\nLOCAL int v[2]\nSTATE a MARKED\nEND\n", "P0402", "bad.net:2:11"),
        ("= bad ( ivec[2] v : )\nSTATE v[1]\nEND\n", "P0402", "`v[1]`, an element of an input"),
        ("= bad ( : )\nLOCAL int n[2]\nOPERATION a MARKED DO n[3] = 1\nEND\n", "P0401", "bad.net:3:23"),
        ("int a,\nGATE g : ->\nEND\n", "P0002", "bad.net:2:1"),
        ("= bad ( : )\nSTATE a MARKED 2\nEND\n", "P0404", "expected at most 1 token in `a`, found 2"),
        ("= bad ( : )\nSTATE a MARKED\nSTATE b\nGATE g : 2*a -> b\nEND\n", "P0404", "at most 1 token from or to `a`"),
        (
            "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE b OF c\nGATE g : a -> b\nEND\n",
            "P0405",
            "help: make a new one: `THEN a -> nothing`, `THEN NEW -> b`",
        ),
        (
            "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE p OF c MARKED\nSTATE b OF c\nGATE g : a, p -> b\nEND\n",
            "P0405",
            "help: say with THEN which token goes where: `THEN p -> b`, `THEN a -> nothing`",
        ),
    ];
    for (text, code, words) in cases {
        let (status, shown) = checked(text);
        assert_eq!(status, Some(1), "{text}\n{shown}");
        assert_eq!(shown.matches("error[").count(), 1, "{text}\n{shown}");
        assert!(shown.contains(code) && shown.contains(words), "{code} {words} for\n{text}\nfound\n{shown}");
    }
    let followed = "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE b OF c\nGATE g : a -> b\nTHEN a -> nothing\nTHEN NEW -> b\nEND\n";
    assert_eq!(checked(followed), (Some(0), String::new()));
}

/// What an operator works a net by is asked for in the head, and named once.
#[test]
fn modes_with_mistakes_are_refused() {
    let heads = "int q, real r = bad ( int x, cell int g = 0, cell real h = 0., cell int m = 0 : )\n";
    let rest = "STATE a MARKED DRIVES q\nOPERATION b DO r = 1.\nEND\n";
    let cases = [
        ("MODE x, h\n", "P0408"),
        ("MODE x, x\n", "P0408"),
        ("MODE h\n", "P0408"),
        ("MODE g, g\n", "P0408"),
        ("MODE x, g, g\n", "P0408"),
        ("MOMENTARY g\nMODE x, g\n", "P0408"),
        ("MOMENTARY m, m\n", "P0408"),
        ("MODE x, g, m, nobody\n", "P0408"),
        ("MODE x, g, m, g, m, g\n", "P0408"),
        ("MODE x\nSTOP q = 1, q = 2\n", "P0408"),
        ("MODE x\nSTOP q = 1.5\n", "P0210"),
        ("MODE x\nSTOP x = 1\n", "P0408"),
        ("MODE x\nSTOP q = 1 r = 2\n", "P0002"),
        ("BLOCKED q\n", "P0407"),
        ("BLOCKED g\n", "P0401"),
    ];
    for (text, code) in cases {
        refused(&format!("{heads}{text}{rest}"), code);
    }
}

/// A net, or a composite with one inside, is no statement: it would stand still between calls.
#[test]
fn statements_do_not_call_nets() {
    let net = "int y = c ( int x : )\nOPERATION a MARKED DO y = CODE ( x : )\nGATE g : a -> a\nEND\n";
    let inner = "int y = inner ( int x : )\nSTATE a MARKED\nSTATE b DRIVES y\nGATE g : a -> b IF x\nEND\n";
    let composite = "int y = comp ( int x : )\nBODY\n1 y = inner ( x : )\nEND\n";
    let program = "CONTROL\n1 x = msi ( : 0 )\n2 I = inner ( x : )\n3 J = comp ( x : )\n4 C = c ( x : )\nEND\n";
    for code in ["inner", "comp"] {
        let folder = tempfile::tempdir().unwrap();
        let net = net.replace("CODE", code);
        let files = [("k.cfg", program), ("inner.net", inner), ("comp.fc", composite), ("c.net", &net)];
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        let output = run(pcl2().args(["check", "k.cfg", "--blocks", "."]).current_dir(folder.path()));
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{shown}");
        assert!(shown.contains("P0408") && shown.contains("MACRO or MODULE"), "{shown}");
    }
}

/// A composite that calls others twice, and these others, is looked into once.
#[test]
fn composites_in_statements_take_no_time() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    for i in 0..40 {
        let inner = if i == 39 { "not".to_owned() } else { format!("c{}", i + 1) };
        let body = format!("1 a = {inner} ( x : )\n2 b = {inner} ( x : )\n3 y = a + b\n");
        write(&format!("c{i}.fc"), &format!("int y = c{i} ( int x : )\nBODY\n{body}END\n"));
    }
    write("deep.net", "int y = deep ( int x : )\nOPERATION a MARKED DO y = c20 ( x : )\nGATE g : a -> a\nEND\n");
    let begun = std::time::Instant::now();
    let output = run(pcl2().args(["check", "deep.net", "--blocks", "."]).current_dir(folder.path()));
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(begun.elapsed().as_secs() < 10);
}

/// In float, a number that only a double holds is refused wherever it stands.
#[test]
fn numbers_fit_into_the_width() {
    let head = "real r = wide ( int x : )\n";
    let cases = [
        "STATE a MARKED\nOPERATION b DO r = 1e300\nGATE g : a -> b\nEND\n",
        "LOCAL real l = 1e300\nSTATE a MARKED\nOPERATION b DO r = l\nGATE g : a -> b\nEND\n",
        "START r = 1e300\nOPERATION b MARKED DO r = 1.\nEND\n",
        "CLASS c ( real n = 1e300 )\nSTATE a OF c MARKED\nOPERATION b OF c DO r = b.n\nGATE g : a -> b\nEND\n",
        "CLASS c ( real n )\nSTATE a OF c MARKED ( n = 1e300 )\nOPERATION b OF c DO r = b.n\nGATE g : a -> b\nEND\n",
        "OPERATION b MARKED DO r = 1.\nTIME t 1e300\nGATE g : b -> t\nEND\n",
        "OPERATION b MARKED DO r = 1.\nSTATE c\nGATE g : b -> c IF r > 1e300\nEND\n",
    ];
    for case in cases {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("wide.net"), format!("{head}{case}")).unwrap();
        let check = |width: &str| run(pcl2().args(["check", "wide.net", "--real", width]).current_dir(folder.path()));
        let shown = String::from_utf8_lossy(&check("f64").stderr).into_owned();
        assert_eq!(check("f64").status.code(), Some(0), "{case}: {shown}");
        let output = check("f32");
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{case}: {shown}");
        assert!(shown.contains("P0004") && shown.contains("a float can hold"), "{case}: {shown}");
    }
}
