//! First pass: every block instance, output, parameter and memory gets its place in the storage.

use super::Unsupported;
use super::net::NetStore;
use crate::ffi::{Kernel, Op};
use pcl2_lang::decl::{Decl, Field, TypeExpr};
use pcl2_lang::kernel::{self, Member};
use pcl2_lang::model;
use pcl2_lang::program::{Block, DeclId, Param, Program, Role, Signal, UnitId};
use pcl2_lang::types::{Real, Scalar, Type, Value, Width};

/// No place: an array without elements, or one that is not known yet.
pub(crate) const NOWHERE: usize = usize::MAX;

/// Composites nest at most this deep.
const MAX_DEPTH: usize = 100;

/// Storage and instances beyond these are left to the C compiler.
const MAX_BYTES: usize = 1 << 32;
const MAX_NODES: usize = 1 << 24;

/// One instance of a block.
#[derive(Debug)]
pub(crate) struct Node {
    /// Its function code.
    pub(crate) decl: DeclId,
    /// Its kernel; none for a composite.
    pub(crate) kernel: Option<Kernel>,
    /// The instance struct.
    pub(crate) instance: usize,
    /// Where the status stands, for a block that can have faults.
    pub(crate) status: Option<usize>,
    /// The storage of each output, groups expanded.
    pub(crate) outputs: Vec<usize>,
    /// The value of each parameter.
    pub(crate) params: Vec<usize>,
    /// Each memory field.
    pub(crate) memory: Vec<usize>,
    /// Each tuned field.
    pub(crate) tuned: Vec<usize>,
    /// The body of a composite.
    pub(crate) inner: Option<Body>,
    /// What a net keeps beside its signals.
    pub(crate) net: Option<Box<NetStore>>,
}

/// One instance of a unit.
#[derive(Debug)]
pub(crate) struct Body {
    /// The unit.
    pub(crate) unit: UnitId,
    /// The storage of each signal; a composite's ports are filled in by the second pass.
    pub(crate) signals: Vec<usize>,
    /// The instances of its blocks.
    pub(crate) nodes: Vec<Node>,
    /// A composite's own parameters.
    pub(crate) own: Vec<usize>,
}

/// What stands in the storage before the first scan.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fill<'a> {
    /// One int.
    Int(i32),
    /// One time.
    Time(i64),
    /// One real.
    Real(Real),
    /// Elements of this type.
    Value(Scalar, usize, &'a Value),
    /// Characters and a NUL.
    Text(&'a str),
}

/// Hands out storage.
#[derive(Debug)]
pub(crate) struct Store<'a> {
    /// The program.
    pub(crate) program: &'a Program,
    /// Bytes handed out.
    pub(crate) bytes: usize,
    /// First values.
    pub(crate) fills: Vec<(usize, Fill<'a>)>,
    /// Int parameters of composites that inner blocks take as reals.
    pub(crate) converts: Vec<Op>,
    /// Where the conversions of each block of the program's own unit start.
    pub(crate) convert_starts: Vec<usize>,
    /// Only parameters get places.
    params_only: bool,
    /// By declaration.
    pub(crate) kernels: Vec<Option<Kernel>>,
    nodes: usize,
}

/// Bytes of one element.
pub(crate) fn width_of(scalar: Scalar, width: Width) -> usize {
    match scalar {
        Scalar::Int => 4,
        Scalar::Real => width.bytes(),
    }
}

impl<'a> Store<'a> {
    /// Finds the kernels of a program. A user's own C is not in this binary.
    pub(crate) fn new(program: &'a Program) -> Result<Store<'a>, Unsupported> {
        let mut store = Store::params_only(program);
        store.params_only = false;
        for (kernel, decl) in store.kernels.iter().zip(&program.decls) {
            if kernel.is_none() && decl.has_kernel() {
                return Err(Unsupported::OwnC(decl.name.clone()));
            }
        }
        Ok(store)
    }

    /// For judging parameters: blocks without a kernel here are not judged.
    pub(crate) fn params_only(program: &'a Program) -> Store<'a> {
        let find = |decl: &Decl| {
            let kernel = Kernel::find(&decl.name, &decl.stem, program.width).filter(|_| !decl.user);
            kernel.filter(|kernel| kernel.offsets().len() == kernel::members(decl).len())
        };
        let kernels = program.decls.iter().map(find).collect();
        let (fills, converts, convert_starts) = (Vec::new(), Vec::new(), Vec::new());
        Store { program, bytes: 0, fills, converts, convert_starts, params_only: true, kernels, nodes: 0 }
    }

    /// Some bytes, aligned to 8.
    pub(crate) fn take(&mut self, bytes: usize) -> Result<usize, Unsupported> {
        if bytes == 0 {
            return Ok(NOWHERE);
        }
        let at = self.bytes;
        let end = at.checked_add(bytes).and_then(|end| end.checked_next_multiple_of(8));
        self.bytes = end.filter(|end| *end <= MAX_BYTES).ok_or(Unsupported::TooLarge)?;
        Ok(at)
    }

    /// Storage of a signal's type.
    pub(crate) fn take_type(&mut self, ty: Type) -> Result<usize, Unsupported> {
        self.take(self.type_bytes(ty))
    }

    /// Bytes of a signal's type.
    pub(crate) fn type_bytes(&self, ty: Type) -> usize {
        ty.elements() * width_of(ty.scalar, self.program.width)
    }

    /// Bytes of a memory, work or tuned field.
    pub(crate) fn field_bytes(&self, field: &Field, sizes: &[i32]) -> usize {
        let element = match field.ty {
            TypeExpr::Time => 8,
            TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => {
                width_of(scalar, self.program.width)
            }
            TypeExpr::Text => 1,
        };
        kernel::field_elements(field, sizes).unwrap_or(0) * element
    }

    /// Storage with a first value.
    pub(crate) fn constant(&mut self, ty: Type, value: &'a Value) -> Result<usize, Unsupported> {
        let at = self.take_type(ty)?;
        if at != NOWHERE {
            self.fills.push((at, Fill::Value(ty.scalar, ty.elements(), value)));
        }
        Ok(at)
    }

    /// Places one instance of a unit. `ready` are signals that live outside: a composite's inout outputs.
    pub(crate) fn body(
        &mut self,
        unit: UnitId,
        own: &[usize],
        ready: &[(usize, usize)],
        depth: usize,
    ) -> Result<Body, Unsupported> {
        if depth > MAX_DEPTH {
            return Err(Unsupported::TooDeep);
        }
        let body = self.program.unit(unit);
        let mut signals = vec![NOWHERE; body.signals.len()];
        for (i, signal) in body.signals.iter().enumerate().filter(|(_, signal)| has_slot(signal)) {
            signals[i] = match ready.iter().find(|(ready, _)| *ready == i) {
                Some((_, at)) => *at,
                None => self.take_type(signal.ty)?,
            };
        }
        let mut nodes = Vec::with_capacity(body.blocks.len());
        for block in &body.blocks {
            if depth == 0 {
                self.convert_starts.push(self.converts.len());
            }
            let params = self.params(unit, block, own)?;
            nodes.push(self.node(unit, block, params, &signals, depth)?);
        }
        for (i, signal) in body.signals.iter().enumerate() {
            if let (false, [writer, ..]) = (has_slot(signal), signal.writers.as_slice()) {
                signals[i] = nodes[writer.block.0 as usize].outputs[writer.output as usize];
            }
        }
        Ok(Body { unit, signals, nodes, own: own.to_vec() })
    }

    /// Places one block of a unit.
    pub(crate) fn node(
        &mut self,
        home: UnitId,
        block: &'a Block,
        params: Vec<usize>,
        signals: &[usize],
        depth: usize,
    ) -> Result<Node, Unsupported> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(Unsupported::TooLarge);
        }
        let decl = self.program.decl(block.decl);
        match block.unit {
            Some(unit) => self.composite(block, decl, unit, params, signals, depth),
            None => self.leaf(home, block, decl, params, signals),
        }
    }

    /// Places the parameters of one block.
    pub(crate) fn params(&mut self, unit: UnitId, block: &'a Block, own: &[usize]) -> Result<Vec<usize>, Unsupported> {
        let decl = self.program.decl(block.decl);
        let mut places = Vec::with_capacity(block.params.len());
        for (param, place) in block.params.iter().zip(&decl.params) {
            places.push(match (param, kernel::resolve(&place.ty, &block.sizes)) {
                (Param::Own(outer), ty) => self.own_param(unit, *outer as usize, own, ty)?,
                (Param::Value(value), Some(ty)) => self.constant(ty, value)?,
                (Param::Value(Value::Text(text)), None) => {
                    let at = self.take(text.len() + 1)?;
                    self.fills.push((at, Fill::Text(text)));
                    at
                }
                (Param::Value(_), None) => NOWHERE,
            });
        }
        Ok(places)
    }

    /// A composite's own parameter in the type that an inner block wants.
    fn own_param(
        &mut self,
        unit: UnitId,
        outer: usize,
        own: &[usize],
        want: Option<Type>,
    ) -> Result<usize, Unsupported> {
        let at = own.get(outer).copied().unwrap_or(NOWHERE);
        let declared = self.program.unit(unit).composite.as_ref().and_then(|(id, sizes)| {
            let param = self.program.decl(*id).params.get(outer)?;
            kernel::resolve(&param.ty, sizes)
        });
        match (declared, want) {
            (Some(found), Some(want))
                if found.scalar == Scalar::Int && want.scalar == Scalar::Real && at != NOWHERE =>
            {
                let to = self.take_type(want)?;
                let step = self.program.width.bytes();
                let each = |i: usize| Op::Convert { from: at + i * 4, to: to + i * step };
                self.converts.extend((0..found.elements().min(want.elements())).map(each));
                Ok(to)
            }
            _ => Ok(at),
        }
    }

    fn composite(
        &mut self,
        block: &'a Block,
        decl: &'a Decl,
        unit: UnitId,
        params: Vec<usize>,
        signals: &[usize],
        depth: usize,
    ) -> Result<Node, Unsupported> {
        let inner = self.program.unit(unit);
        let mut ready = Vec::new();
        let mut expanded = 0;
        for output in &decl.outputs {
            for _ in 0..kernel::count(output.group.as_ref(), &block.sizes).unwrap_or(0) {
                if let (true, Some(signal)) = (output.inout, inner.outputs.get(expanded)) {
                    ready.push((signal.0 as usize, signals[block.outputs[expanded].0 as usize]));
                }
                expanded += 1;
            }
        }
        let body = self.body(unit, &params, &ready, depth + 1)?;
        let outputs = inner.outputs.iter().map(|signal| body.signals[signal.0 as usize]).collect();
        let net = decl.net.as_deref().map(|net| self.net(net, &body)).transpose()?.map(Box::new);
        let can_fault = net.is_some() || body.nodes.iter().any(|node| node.status.is_some());
        let status = if can_fault { Some(self.take(4)?) } else { None };
        let (decl, kernel, instance) = (block.decl, None, NOWHERE);
        Ok(Node {
            decl,
            kernel,
            instance,
            status,
            outputs,
            params,
            memory: Vec::new(),
            tuned: Vec::new(),
            inner: Some(body),
            net,
        })
    }

    fn leaf(
        &mut self,
        home: UnitId,
        block: &'a Block,
        decl: &'a Decl,
        params: Vec<usize>,
        signals: &[usize],
    ) -> Result<Node, Unsupported> {
        let kernel = self.kernels[block.decl.0 as usize];
        if self.params_only {
            let (outputs, memory, tuned) = (vec![NOWHERE; block.outputs.len()], Vec::new(), Vec::new());
            let (decl, instance, status) = (block.decl, NOWHERE, None);
            return Ok(Node { decl, kernel, instance, status, outputs, params, memory, tuned, inner: None, net: None });
        }
        let instance = self.take(kernel.map_or(0, Kernel::size))?;
        let members = kernel::members(decl);
        let offsets = kernel.map_or(&[][..], Kernel::offsets);
        let member = |wanted: Member| {
            let found = members.iter().position(|member| *member == wanted)?;
            offsets.get(found).map(|offset| instance + *offset as usize)
        };
        let mut memory = Vec::with_capacity(decl.memory.len());
        for (i, field) in decl.memory.iter().enumerate() {
            memory.push(self.field(field, &block.sizes, member(Member::Memory(i)))?);
        }
        let mut tuned = Vec::with_capacity(decl.tuned.len());
        for (i, field) in decl.tuned.iter().enumerate() {
            tuned.push(self.field(field, &block.sizes, member(Member::Tuned(i)))?);
        }
        let mut outputs = Vec::with_capacity(block.outputs.len());
        for (i, output) in decl.outputs.iter().enumerate() {
            let count = kernel::count(output.group.as_ref(), &block.sizes).unwrap_or(0);
            let ty = kernel::resolve(&output.ty, &block.sizes).unwrap_or(Type::REAL);
            let open = model::is_open(self.program.unit(home), block, decl, i);
            let bytes = if open { 0 } else { self.type_bytes(ty) };
            let base = match member(Member::Output(i)) {
                Some(at) => at,
                None if output.inout => block.outputs.get(outputs.len()).map_or(NOWHERE, |id| signals[id.0 as usize]),
                None => self.take(bytes.checked_mul(count).ok_or(Unsupported::TooLarge)?)?,
            };
            outputs.extend((0..count).map(|j| if bytes == 0 { NOWHERE } else { base + j * bytes }));
        }
        let status = match member(Member::Status) {
            None if kernel::faults_by_result(decl) => Some(self.take(4)?),
            status => status,
        };
        Ok(Node { decl: block.decl, kernel, instance, status, outputs, params, memory, tuned, inner: None, net: None })
    }

    fn field(&mut self, field: &Field, sizes: &[i32], member: Option<usize>) -> Result<usize, Unsupported> {
        match member {
            Some(at) => Ok(at),
            None => self.take(self.field_bytes(field, sizes)),
        }
    }
}

/// Whether a signal has storage of its own: it has several writers, one that changes it in place, or none.
pub(crate) fn has_slot(signal: &Signal) -> bool {
    match signal.writers.as_slice() {
        [] => !matches!(signal.role, Role::Port(_)),
        [writer] => writer.inout || signal.role == Role::Held,
        [..] => true,
    }
}
