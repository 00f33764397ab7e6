use super::format;
use crate::source::Sources;

fn formatted(text: impl Into<Vec<u8>>) -> Vec<u8> {
    let mut sources = Sources::default();
    let file = sources.add("a.cfg", text.into());
    format(sources.file(file)).expect("the same tokens")
}

/// Formats to this, and this to itself.
fn gives(text: &str, expected: &str) {
    let found = String::from_utf8(formatted(text)).unwrap();
    assert_eq!(found, expected);
    assert_eq!(String::from_utf8(formatted(expected)).unwrap(), expected, "not stable");
}

#[test]
fn numbers_names_and_comments_are_aligned() {
    gives(
        " CONTROL  10 5 ! rate\n9 w=msc(:1.) ! set point\n10 long , b=f( w,  a [1] :K=-1.,, ) ! why\n\
         !what\n  z = g (:)\n\n\n\n=h( TAG . bk,,x : ) \nEND",
        "CONTROL 10 5                             ! rate\n \
         9 w       = msc ( : 1. )                ! set point\n\
         10 long, b = f ( w, a[1] : K = -1., , )  ! why\n\
         !what\n   z = g ( : )\n\n   = h ( TAG.bk, , x : )\nEND",
    );
}

#[test]
fn what_follows_end_and_every_comment_keep_their_bytes() {
    let text = b"CONTROL\r\n1  y=f(:)!\xb0\xa1  \t\r\n!\xb0 \r\nEND  \r\n\n\xff 1  y=f(:)";
    let expected = b"CONTROL\r\n1 y = f ( : )  !\xb0\xa1  \t\r\n!\xb0 \r\nEND  \r\n\n\xff 1  y=f(:)";
    assert_eq!(formatted(text), expected);
    assert_eq!(formatted(expected), expected);
}

#[test]
fn breaks_behind_commas_stay_and_the_colon_begins_a_line() {
    gives(
        "CONTROL\n1 A = setmat ( 2, 2 :\n1., 2.,\n  3.\n, 4. )\n2 b = f (\nx : y\n)\nEND\n",
        "CONTROL\n1 A = setmat ( 2, 2\n             : 1., 2.,\n               3.,\n               4. )\n\
         2 b = f ( x : y )\nEND\n",
    );
}

#[test]
fn breaks_around_empty_places_stay() {
    let expected = "CONTROL\n1 y = f ( a,\n          ,\n          , b : )\nEND\n";
    gives("CONTROL\n1 y = f ( a\n, ,\n, b : )\nEND\n", expected);
    gives(expected, expected);
}

#[test]
fn long_lists_are_broken_at_the_colon_and_where_a_line_is_full() {
    let list = |n: usize| vec!["0.25"; n].join(", ");
    gives(
        &format!("CONTROL\n1 A = setmat ( 1, 30 : {} )\nEND\n", list(28)),
        &format!("CONTROL\n1 A = setmat ( 1, 30\n             : {},\n               {} )\nEND\n", list(14), list(14),),
    );
}

#[test]
fn a_comment_below_a_comment_goes_on_in_its_column() {
    gives(
        "CONTROL\n1 w = msc ( : 1. ) ! set\n                   ! point\n  ! other\n2 y = f ( a, ! first\n! inner\n b : )\nEND\n",
        "CONTROL\n1 w = msc ( : 1. )  ! set\n                    ! point\n! other\n2 y = f ( a,  ! first\n          ! inner\n          b : )\nEND\n",
    );
}

#[test]
fn expressions_are_dense_where_they_bind() {
    gives(
        "CONTROL\n1 y=x1 * x1/( 1.+x2 )-- 3.*sqrt ( a [ 1 ] )\nEND\n",
        "CONTROL\n1 y = x1*x1/(1. + x2) - -3.*sqrt(a[1])\nEND\n",
    );
}
