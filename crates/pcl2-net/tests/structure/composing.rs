//! Matrices as text, and their composition.

use crate::nets::{net, place_id, tank};
use pcl2_net::structure::compose::{Piece, compose};
use pcl2_net::structure::divide::divide;
use pcl2_net::structure::matrix::{Matrix, MatrixKind};

const STEPS: [&str; 7] = ["S0", "S1", "S2", "S3", "S4", "S5", "S6"];

fn csv(matrix: &Matrix) -> String {
    let mut bytes = Vec::new();
    matrix.write_csv(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn text(matrix: &Matrix) -> String {
    let mut bytes = Vec::new();
    matrix.write_text(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// The entries that are not zero, by names.
fn named(matrix: &Matrix) -> Vec<(String, String, i128)> {
    let mut named = Vec::new();
    for row in 0..matrix.rows.len() {
        for (column, value) in matrix.row(row) {
            named.push((matrix.rows[row].clone(), matrix.columns[*column as usize].clone(), *value));
        }
    }
    named.sort();
    named
}

#[test]
fn matrices_show_names_and_keep_reads_apart() {
    let net = net("a=1 bb", "t: 10*a -> bb\nturn: 2*bb -> 2*bb a ? a");
    assert_eq!(text(&Matrix::of(&net, MatrixKind::Change)), "B     t  turn\na   -10     1\nbb    1     .\n");
    assert_eq!(text(&Matrix::of(&net, MatrixKind::Takes)), "B-   t  turn\na   10     .\nbb   .     2\n");
    assert_eq!(text(&Matrix::of(&net, MatrixKind::Puts)), "B+  t  turn\na   .     1\nbb  1     2\n");
    assert_eq!(text(&Matrix::of(&net, MatrixKind::Reads)), "read  t  turn\na     .     1\nbb    .     .\n");
    assert_eq!(csv(&Matrix::of(&net, MatrixKind::Change)), "B,t,turn\na,-10,1\nbb,1,0\n");
}

#[test]
fn a_csv_is_read_as_it_was_written() {
    let net = net("a,b=1 \"q\" c", "t: 18446744073709551615*a,b -> \"q\"\nu,1: c -> 3*c");
    for kind in MatrixKind::ALL {
        let matrix = Matrix::of(&net, kind);
        assert_eq!(Matrix::read_csv(csv(&matrix).as_bytes()), Ok(matrix));
    }
    let empty = Matrix::zero("B", Vec::new(), Vec::new());
    assert_eq!(Matrix::read_csv(csv(&empty).as_bytes()), Ok(empty));
}

#[test]
fn what_is_wrong_with_a_csv_is_told_with_its_place() {
    let read = |text: &str| Matrix::read_csv(text.as_bytes()).unwrap_err();
    assert_eq!(read("B,t,u\na,1,x\n"), "line 2, column 3 (u): expected an integer below 2^64, found `x`");
    assert_eq!(
        read("B,t\na,18446744073709551616\n"),
        "line 2, column 2 (t): expected an integer below 2^64, found `18446744073709551616`"
    );
    assert_eq!(read("B,t,t\n"), "line 1, column 3: `t` stands in an earlier column");
    assert_eq!(read("B,t\na,1\na,2\n"), "line 3, column 1: `a` stands in an earlier row");
    let one = "a file has one matrix: `net matrix --csv` writes one with --of and --kind";
    assert_eq!(read("B,t\n\na,1,2\n"), format!("line 3: expected 2 fields, found 3; {one}"));
    assert_eq!(read("B,t\na,1\n\nB+,t\n"), format!("line 4: expected a row of `B`, found a second matrix; {one}"));
    assert_eq!(read(""), "expected a line with the names of transitions, found nothing");
    assert_eq!(Matrix::read_csv(b"B,t\na,\xff\n").unwrap_err(), "line 2: expected UTF-8 text, found other bytes");
}

#[test]
fn the_tanks_main_loop_and_sub_nets_compose_to_the_whole() {
    let net = tank();
    let division = divide(&net, &STEPS).unwrap();
    for kind in [MatrixKind::Takes, MatrixKind::Puts, MatrixKind::Change] {
        let pieces: Vec<Piece> = division
            .pieces(&net, kind)
            .into_iter()
            .map(|piece| Piece { name: piece.name, matrix: Matrix::read_csv(csv(&piece.matrix).as_bytes()).unwrap() })
            .collect();
        let composition = compose(&pieces).unwrap();
        assert_eq!((composition.matrix.rows.len(), composition.matrix.columns.len()), (22, 23));
        assert_eq!(named(&composition.matrix), named(&Matrix::of(&net, kind)));
        if kind == MatrixKind::Change {
            let copies: Vec<String> =
                composition.modules.iter().map(|module| format!("{} {}", module.module, module.copies)).collect();
            assert_eq!(copies, ["S 1", "P 1", "L 2", "V1 2", "Z1 2", "D2 1", "V2 2", "D1 1"]);
        }
    }
}

fn piece(name: &str, text: &str) -> Piece {
    Piece { name: name.to_owned(), matrix: Matrix::read_csv(text.as_bytes()).unwrap() }
}

#[test]
fn copies_that_differ_are_refused_by_name() {
    let one = piece("one", "B,tv10,tv11\nV11,1,-1\nV10,-1,1\n");
    let other = piece("other", "B,tv10,tv11\nV11,1,-1\nV10,-1,2\n");
    let message =
        "module `V1`, place `V10`, transition `tv11`: expected equal copies, found 1 in `one` and 2 in `other`";
    assert_eq!(compose(&[one.clone(), other]).unwrap_err(), message);
    let zero = piece("other", "B,tv10,tv11\nV11,1,0\nV10,-1,1\n");
    let message =
        "module `V1`, place `V11`, transition `tv11`: expected equal copies, found -1 in `one` and 0 in `other`";
    assert_eq!(compose(&[one, zero]).unwrap_err(), message);
}

#[test]
fn copies_that_are_not_whole_are_refused_by_name() {
    let one = piece("one", "B,tv10,tv11\nV11,1,-1\nV10,-1,1\n");
    let column = piece("other", "B,tv10\nV11,1\nV10,-1\n");
    let message = "module `V1`: expected whole copies, found none of the transition `tv11` of `one` in `other`";
    assert_eq!(compose(&[one.clone(), column]).unwrap_err(), message);
    let row = piece("other", "B,tv10,tv11\nV11,1,-1\n");
    let message = "module `V1`: expected whole copies, found none of the place `V10` of `one` in `other`";
    assert_eq!(compose(&[one, row]).unwrap_err(), message);
}

#[test]
fn three_copies_count_once_and_unconnected_names_stay() {
    let copy = |name: &str| piece(name, "B+,t,u\na,4,1\nb,0,0\n");
    let composition = compose(&[copy("x"), copy("y"), copy("z"), piece("w", "B+,v\nc,0\n")]).unwrap();
    assert_eq!(csv(&composition.matrix), "B+,t,u,v\na,4,1,0\nb,0,0,0\nc,0,0,0\n");
    assert_eq!(composition.modules.iter().map(|module| module.copies).collect::<Vec<_>>(), [3, 3, 1, 1]);
    let nothing = compose(&[]).unwrap();
    assert_eq!((nothing.matrix.rows.len(), nothing.modules.len()), (0, 0));
}

#[test]
fn a_part_of_a_matrix_is_in_the_order_asked_for() {
    let net = tank();
    let places = ["V10", "V11"].map(|name| place_id(&net, name));
    let transitions = ["tv11", "tv10"].map(|name| crate::nets::transition_id(&net, name));
    let matrix = Matrix::of_part(&net, MatrixKind::Change, &places, &transitions);
    assert_eq!(csv(&matrix), "B,tv11,tv10\nV10,1,-1\nV11,-1,1\n");
}
