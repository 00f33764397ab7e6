//! Finding an element by the name that people write: `w.value`, `8.den[2]`, `m[1,2]`, `ain(0,1,1)`.

use pcl2_lang::model::{self, Index, Point};
use pcl2_lang::program::{Program, UnitId};
use pcl2_lang::suggest;
use pcl2_lang::types::{Shape, Type};
use rustc_hash::FxHashMap;

/// The named points of one program.
pub struct Names<'a> {
    /// The program.
    pub program: &'a Program,
    /// Its points, in the order of [`model::points`].
    pub points: Vec<Point>,
    index: Index,
    /// Elements with a name of their own.
    own: FxHashMap<String, Element>,
}

/// One element of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Element {
    /// Index into [`Names::points`].
    pub point: u32,
    /// Counted from 0, row-major.
    pub element: u32,
}

impl<'a> Names<'a> {
    /// Lists the program's points.
    pub fn new(program: &'a Program) -> Names<'a> {
        let points = model::points(program);
        let index = Index::new(program, &points);
        let mut own = FxHashMap::default();
        for (i, point) in points.iter().enumerate() {
            for element in 0..point.elements.len() as u32 {
                own.extend(point.element_name(element).map(|name| (name, Element { point: i as u32, element })));
            }
        }
        Names { program, points, index, own }
    }

    /// The point of an element.
    pub fn point(&self, element: Element) -> &Point {
        &self.points[element.point as usize]
    }

    /// All elements that a name stands for: a scalar or an element one, a whole vector or matrix each of its own.
    pub fn elements(&self, name: &str) -> Result<Vec<Element>, String> {
        if let Some(element) = self.own.get(name) {
            return Ok(vec![*element]);
        }
        if let Some(point) = self.whole(name)? {
            let count = self.points[point as usize].ty.elements() as u32;
            return Ok((0..count).map(|element| Element { point, element }).collect());
        }
        self.indexed(name).map(|element| vec![element])
    }

    /// The one element that a name stands for.
    pub fn element(&self, name: &str) -> Result<Element, String> {
        if let Some(element) = self.own.get(name) {
            return Ok(*element);
        }
        let Some(point) = self.whole(name)? else {
            return self.indexed(name);
        };
        let ty = self.points[point as usize].ty;
        if ty.is_scalar() {
            return Ok(Element { point, element: 0 });
        }
        Err(format!("`{name}` is a {ty}: name an element, such as `{name}{}`", suffix(ty, 0)))
    }

    /// The name of an element, as trace headers have it.
    pub fn label(&self, element: Element) -> String {
        let point = self.point(element);
        if let Some(name) = point.element_name(element.element) {
            return name;
        }
        format!("{}{}", point.name, suffix(point.ty, element.element))
    }

    fn whole(&self, name: &str) -> Result<Option<u32>, String> {
        match self.index.find(name) {
            Some(Some(point)) => Ok(Some(point as u32)),
            Some(None) => Err(format!(
                "several blocks that write this variable have the parameter `{name}`: use a block's number"
            )),
            None => Ok(None),
        }
    }

    fn indexed(&self, name: &str) -> Result<Element, String> {
        let Some((base, places)) = split(name) else {
            return Err(self.unknown(name));
        };
        let Some(point) = self.whole(base)? else {
            return Err(self.unknown(base));
        };
        let ty = self.points[point as usize].ty;
        match place(ty, &places) {
            Some(element) => Ok(Element { point, element }),
            None => Err(format!("`{name}`: `{base}` is a {ty} and has no such element")),
        }
    }

    fn unknown(&self, name: &str) -> String {
        if let Some(reason) = self.fixed_parameter(name) {
            return reason;
        }
        let known = self.points.iter().map(|point| point.name.as_str());
        match suggest::closest(name, known) {
            Some(near) => format!("nothing has the name `{name}`; did you mean `{near}`?"),
            None => format!("nothing has the name `{name}`"),
        }
    }

    /// A parameter that exists and does not stay in RAM.
    fn fixed_parameter(&self, name: &str) -> Option<String> {
        let (tag, param) = name.split_once('.')?;
        let unit = self.program.unit(UnitId(0));
        let called = |block: &&pcl2_lang::program::Block| block.name == tag || block.number.to_string() == tag;
        let block = unit.blocks.iter().find(called)?;
        let decl = self.program.decl(block.decl);
        let param = decl.params.iter().find(|known| known.name == param)?;
        Some(if param.fixed {
            format!("`{name}` is fixed: `{}` declares it so", decl.name)
        } else {
            format!("`{name}` is not tunable here")
        })
    }
}

/// `[3]` or `[2,1]` for an element of a vector or matrix, nothing for a scalar.
pub fn suffix(ty: Type, element: u32) -> String {
    match ty.shape {
        Shape::Scalar => String::new(),
        Shape::Vector(_) => format!("[{}]", element + 1),
        Shape::Matrix(_, columns) => format!("[{},{}]", element / columns + 1, element % columns + 1),
    }
}

fn split(name: &str) -> Option<(&str, Vec<u32>)> {
    let (base, rest) = name.split_once('[')?;
    let places = rest.strip_suffix(']')?.split(',').map(|place| place.trim().parse().ok());
    Some((base.trim_end(), places.collect::<Option<Vec<u32>>>()?))
}

fn place(ty: Type, places: &[u32]) -> Option<u32> {
    let inside = |place: u32, size: u32| (1..=size).contains(&place).then(|| place - 1);
    match (ty.shape, places) {
        (Shape::Vector(n), [i]) => inside(*i, n),
        (Shape::Matrix(rows, columns), [i, j]) => Some(inside(*i, rows)? * columns + inside(*j, columns)?),
        (Shape::Scalar | Shape::Vector(_) | Shape::Matrix(..), _) => None,
    }
}
