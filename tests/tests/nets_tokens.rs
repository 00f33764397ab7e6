//! Which token a statement of a net sees, and which one a gate takes.

use pcl2_tests::nets::{column, traced};

/// A time may be an attribute of the token that it holds back.
#[test]
fn a_time_is_an_attribute_of_its_token() {
    let net = "= late ( : )
CLASS c ( real d = 1. )
CAPACITY queue SIZE 3 OF c MARKED ( d = 2. )
TIME hold hold.d OF c
STATE done OF c
GATE g : queue -> hold
GATE h : hold -> done
END
";
    let trace = traced(&[("late.net", net)], "", &["--steps", "7", "--period", "0.5"]);
    assert_eq!(column(&trace, "late.hold"), [1., 1., 1., 1., 0., 0., 0.]);
}

/// An argument of a net inside may be an attribute: of the first token, or of a new one where there is none.
#[test]
fn an_argument_is_an_attribute_of_the_first_token() {
    let outer = "real r = outer ( int go : )
CLASS c ( real d = 0.5 )
CAPACITY queue SIZE 3 OF c MARKED ( d = 2. )
MODULE M : r = inner ( queue.d : )
GATE g : queue -> IF go
END
";
    let inner =
        "real r = inner ( real d : )\nSTATE a MARKED\nOPERATION b DO r = d\nGATE g : a -> b\nGATE h : b -> a\nEND\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], "k,go\n0,0\n3,1\n", &["--steps", "7"]);
    assert_eq!(column(&trace, "r"), [0., 2., 2., 2., 2., 0.5, 0.5]);
}

/// A permissive and all statements of a gate see the token that its condition chose, and this one goes.
#[test]
fn a_gate_keeps_to_the_token_that_it_chose() {
    let net = "int told, int seen, int again = chosen ( int n, int in : )
CLASS c ( int n = 0, int m = 7 )
GENERATE make OF c SIZE 1 WHEN in DO make.n = n
CAPACITY wait OF c SIZE 5
STATE board OF c MARKED ( n = 2, m = 8 )
OPERATION show OF c DO told = show.n
GATE g1 : make -> wait
GATE g2 : wait -> show READ board PERMIT wait.n > 1 IF wait.n == board.n
DO seen = wait.n + board.m
DO again = wait.n + board.m
END
";
    let stimulus = "k,n,in\n0,1,1\n1,1,0\n2,2,1\n3,2,0\n4,3,1\n5,3,0\n";
    let trace = traced(&[("chosen.net", net)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "chosen.wait"), [1., 1., 2., 1., 2., 2., 2., 2.]);
    assert_eq!(column(&trace, "told"), [0., 0., 0., 0., 2., 2., 2., 2.]);
    assert_eq!(column(&trace, "seen"), [0., 0., 0., 10., 10., 10., 10., 10.]);
    assert_eq!(column(&trace, "again"), column(&trace, "seen"));
}

/// The cause of a process box is seen by a gate that reads the box, though another gate has taken the token.
#[test]
fn a_cause_outlasts_the_token() {
    let net = "int n, int m = caused ( : )
PROCESS p UNTIL 1 MARKED
AFTER p.ready = 1
GATE takes : p ->
DO n = n + 1
GATE reads : -> READ p IF NOT p.cause
DO m = m + 1
END
";
    let trace = traced(&[("caused.net", net)], "", &["--steps", "4"]);
    assert_eq!(column(&trace, "n"), [0., 1., 1., 1.]);
    assert_eq!(column(&trace, "m"), [0., 1., 1., 1.]);
}

/// A new token is new, also in the box whose token the gate took away.
#[test]
fn a_new_token_has_the_first_values() {
    let net = "int told, int sent, int seen = renew ( int go : )
CLASS c ( int n = 1 )
STATE seat OF c MARKED ( n = 5 )
OPERATION out OF c DO sent = out.n
GATE g : seat -> seat, out IF go
THEN NEW -> seat
THEN seat -> out
DO seen = seat.n
GATE h : out -> IF NOT go
DO told = seat.n
END
";
    let trace = traced(&[("renew.net", net)], "k,go\n0,1\n1,0\n", &["--steps", "4"]);
    assert_eq!(column(&trace, "seen"), [5.; 4]);
    assert_eq!(column(&trace, "sent"), [0., 5., 5., 5.]);
    assert_eq!(column(&trace, "told"), [0., 1., 1., 1.]);
}

/// A macro's token is what its exit has, once it is there.
#[test]
fn a_macro_shows_the_token_that_comes_out() {
    let outer = "int v, int w = outer ( int go : )
CLASS c ( int a = 1 )
STATE s OF c MARKED
OPERATION o OF c DO w = o.a
MACRO M = inner ( : )
GATE in : s -> M
GATE out : M -> o IF M.a > 5 AND go
DO v = M.a
END
";
    let inner = "= inner ( : )
CLASS c ( int a = 1 )
ENTRY come OF c
EXIT gone OF c
GATE way : come -> gone
DO come.a = 10
END
";
    let stimulus = "k,go\n0,1\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], stimulus, &["--steps", "5"]);
    assert_eq!(column(&trace, "v"), [0., 0., 10., 10., 10.]);
    assert_eq!(column(&trace, "w"), [0., 0., 0., 10., 10.]);
}

/// No token enters a macro while anything beside the exit is marked, not even through a gate that empties the exit.
#[test]
fn a_macro_is_not_entered_again_before_it_is_empty() {
    let outer = "= outer ( int go : )
STATE s MARKED
MACRO M = inner ( go : )
GATE in : s -> M
GATE again : M -> M
END
";
    let inner = "= inner ( int go : )
ENTRY come
STATE side
EXIT gone
GATE way : come -> gone, side
GATE over : side -> IF go
END
";
    let stimulus = "k,go\n0,0\n4,1\n5,0\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "outer.M.gone"), [0., 1., 1., 1., 1., 0., 1., 1.]);
    assert_eq!(column(&trace, "outer.M.side"), [0., 1., 1., 1., 0., 0., 1., 1.]);
}

/// Tokens are ordered by ints as they are, also where a float could not tell them apart; bad values go last.
#[test]
fn keys_are_compared_as_they_are() {
    let net = "int out = order ( int in, int n, int go : )
CLASS job ( int n = 0 )
GENERATE make OF job SIZE 1 WHEN in DO make.n = n
CAPACITY wait OF job SIZE 5 ORDER most n
OPERATION show OF job DO out = show.n
GATE g1 : make -> wait
GATE g2 : wait -> show IF go
GATE g3 : show ->
END
";
    let stimulus = "k,in,n,go\n0,1,16777216,0\n1,0,0,0\n2,1,16777217,0\n3,0,0,0\n4,0,0,1\n";
    let args = ["--steps", "8", "--real", "f32"];
    let trace = traced(&[("order.net", net)], stimulus, &args);
    assert_eq!(column(&trace, "out"), [0., 0., 0., 0., 0., 16777217., 16777217., 16777216.]);
    let net = net.replace("int n, int go", "real n, int go").replace("int n = 0", "real n = 0.");
    let net = net.replace("int out", "real out").replace("most n", "least n");
    let stimulus = "k,in,n,go\n0,1,nan,0\n1,0,0,0\n2,1,-inf,0\n3,0,0,0\n4,1,5,0\n5,0,0,1\n";
    let trace = traced(&[("order.net", &net)], stimulus, &["--steps", "7"]);
    assert_eq!(column(&trace, "out")[6], 5.);
}
