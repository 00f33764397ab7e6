//! The border to the C kernels: the one file with `unsafe`.
//!
//! Why it is sound:
//! * All storage of a running program is one allocation, [`Bound::words`], that never moves or grows. Rust reads and
//!   writes it through `Cell`, C through pointers taken from it, and never both at once: C runs only inside
//!   [`Bound::run`], on this thread (raw pointers make [`Bound`] neither `Send` nor `Sync`).
//! * [`Bound::new`] checks every range of bytes in the plan against the allocation and its alignment before it makes
//!   a pointer of it.
//! * A thunk reads as many pointers as its function has arguments and results, and so many stand in the table:
//!   `build.rs` and the wiring both go by `kernel::args` of one declaration, and the length of each slot by its sizes.
//!   The kernels stay inside the ranges that their declaration gives, as any C of the runtime does.
//! * The tables of kernels are constants of this binary, written by `build.rs` from the same declarations.
//! * The player of nets walks a table that `pcl2_lang::net::table` makes of a checked net, over arrays of the lengths that
//!   `engine/net.rs` takes for it. It runs inside [`Bound::run`] too, and calls back into [`act`] and [`duration`] with
//!   the net that it was given: these reach the storage through pointers alone. Nets, their hosts and the tapes that
//!   these point to stay where they are until [`Bound`] is dropped.
#![allow(unsafe_code)]

use crate::health::{FaultAt, Health};
use pcl2_lang::kernel::Entry;
use pcl2_lang::types::Width;
use std::cell::Cell;
use std::ffi::c_void;
use std::ops::Range;

mod names {
    include!(concat!(env!("OUT_DIR"), "/kernels.rs"));
}

const COUNT: usize = names::NAMES.len();

type Thunk = unsafe extern "C" fn(*const *mut c_void);

/// One row of the tables that build.rs writes.
#[repr(C)]
struct Row {
    size: u32,
    members: u32,
    offsets: *const u32,
    step: Option<Thunk>,
    init: Option<Thunk>,
    tune: Option<Thunk>,
    check: Option<Thunk>,
}

// SAFETY: the rows are constants; nothing writes them or what they point to.
unsafe impl Sync for Row {}

unsafe extern "C" {
    static pcl2_kernels_f64: [Row; COUNT];
    static pcl2_kernels_f32: [Row; COUNT];
}

/// A kernel in one width.
#[derive(Clone, Copy)]
pub(crate) struct Kernel(&'static Row);

/// One of a kernel's functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Function(Thunk);

impl Kernel {
    /// The kernel of a function code of the catalogue.
    pub(crate) fn find(name: &str, stem: &str, width: Width) -> Option<Kernel> {
        let index = names::NAMES.iter().position(|known| *known == (name, stem))?;
        // SAFETY: the tables have COUNT rows and are never written.
        let rows = unsafe {
            match width {
                Width::F64 => &pcl2_kernels_f64,
                Width::F32 => &pcl2_kernels_f32,
            }
        };
        rows.get(index).map(Kernel)
    }

    /// Bytes of the instance struct.
    pub(crate) fn size(self) -> usize {
        self.0.size as usize
    }

    /// The offset of each member of the instance struct.
    pub(crate) fn offsets(self) -> &'static [u32] {
        if self.0.offsets.is_null() {
            return &[];
        }
        // SAFETY: the row says how many constants its pointer leads to.
        unsafe { std::slice::from_raw_parts(self.0.offsets, self.0.members as usize) }
    }

    /// One of its functions.
    pub(crate) fn function(self, entry: Entry) -> Option<Function> {
        match entry {
            Entry::Step => self.0.step,
            Entry::Init => self.0.init,
            Entry::Tune => self.0.tune,
            Entry::Check => self.0.check,
        }
        .map(Function)
    }
}

impl std::fmt::Debug for Kernel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Kernel({} bytes)", self.0.size)
    }
}

/// A range of bytes of a program's storage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot {
    /// First byte, a multiple of 4, for 8-byte elements of 8.
    pub(crate) at: usize,
    /// How many. None at all: the kernel gets NULL.
    pub(crate) bytes: usize,
}

/// One thing to do, places as bytes of the storage.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op {
    /// Calls a kernel's function with `count` of the plan's arguments, from `first`.
    Call { function: Function, first: usize, count: usize },
    /// An int as a real.
    Convert { from: usize, to: usize },
    /// Bytes to another place.
    Copy { from: usize, to: usize, bytes: usize },
    /// The status of a code that keeps none: 1 if the last of `count` real arguments from `first` is bad although no
    /// other is.
    Judge { first: usize, count: usize, at: usize },
    /// Forgets the status of a composite.
    Clear { at: usize },
    /// Hands a status out of a composite; the first stays.
    Carry { from: usize, to: usize },
    /// Counts a fault of a block if there is one.
    Fault { at: usize, block: u32 },
    /// One scan of a net and of those in it: so many of the plan's nets from `first`.
    Net { first: usize, count: usize },
}

/// The result of a statement of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// It has none.
    None,
    /// An int.
    Int(usize),
    /// A real.
    Real(usize),
}

/// A statement of a net.
#[derive(Clone, Debug)]
pub(crate) struct Script {
    /// What is done, on the tape of statements.
    pub(crate) ops: Range<usize>,
    /// Its result.
    pub(crate) answer: Answer,
    /// The reals that it reads: a condition over a bad one is not true.
    pub(crate) reals: Vec<usize>,
}

/// A net, in places instead of pointers.
#[derive(Clone, Debug)]
pub(crate) struct NetPlan {
    /// The table.
    pub(crate) table: Vec<i32>,
    /// box, taken, filled, used, phase, by, hold, since, ints, reals, wrote, active, active_since, lost, conflicts; of a
    /// net with modes also stood, halted, forced, refused.
    pub(crate) arrays: Vec<Slot>,
    /// Where each word is.
    pub(crate) words: Vec<usize>,
    /// Where the attributes of tokens in hand are.
    pub(crate) hands: Vec<usize>,
    /// The net around it.
    pub(crate) outer: Option<usize>,
    /// The statement of that net that takes the inputs in.
    pub(crate) inputs: i32,
    /// Its statements.
    pub(crate) scripts: Vec<Script>,
    /// What takes in its inputs, on the tape of statements.
    pub(crate) latch: Range<usize>,
    /// Where its status is.
    pub(crate) status: usize,
    /// The period of its scans, nanoseconds.
    pub(crate) period: i64,
}

/// `struct pcl2_net`
#[repr(C)]
struct Player {
    table: *const i32,
    base: *mut u8,
    arrays: [*mut c_void; ROW],
    words: *const usize,
    hands: *const usize,
    wrote: *mut c_void,
    active: *mut c_void,
    active_since: *mut c_void,
    outer: *mut Player,
    inputs: i32,
    now: i64,
    mode: i32,
    blocked: i32,
    switched: i32,
    status: *mut i32,
    lost: *mut c_void,
    conflicts: *mut c_void,
    operated: [*mut c_void; OPERATED],
    act: unsafe extern "C" fn(*const Player, i32) -> i32,
    duration: unsafe extern "C" fn(*const Player, i32) -> i64,
    host: *const c_void,
}

/// How many of a net's arrays stand one after the other in `struct pcl2_net`: from `box` to `reals`.
const ROW: usize = 10;

/// How many arrays stand behind those.
const MORE: usize = 5;

/// How many more a net with modes has.
const OPERATED: usize = 4;

unsafe extern "C" {
    fn pcl2_net_scan(nets: *mut Player, n: i32, now: *mut i64, period: i64);
    fn pcl2_net_nanoseconds(seconds: *const f64) -> i64;
    fn pcl2f_net_scan(nets: *mut Player, n: i32, now: *mut i64, period: i64);
    fn pcl2f_net_nanoseconds(seconds: *const f32) -> i64;
}

/// The result of a statement as a pointer.
#[derive(Clone, Copy)]
enum Returned {
    None,
    Int(*const i32),
    Wide(*const f64),
    Narrow(*const f32),
}

struct BareScript {
    ops: Range<usize>,
    answer: Returned,
    reals: Vec<*const c_void>,
}

/// What the player's calls back find: one for each net.
struct Host {
    tape: *const Bare,
    scripts: Vec<BareScript>,
    latch: Range<usize>,
    period: i64,
    width: Width,
    table: Vec<i32>,
    words: Vec<usize>,
    hands: Vec<usize>,
}

/// Runs a statement: of a condition its truth.
unsafe extern "C" fn act(net: *const Player, script: i32) -> i32 {
    // SAFETY: the player hands back the net that it was given, and indexes of its own table.
    unsafe {
        let host = (*net).host.cast::<Host>();
        let script: *const BareScript = (*host).scripts.as_ptr().add(script as usize);
        for i in (*script).ops.clone() {
            perform(&*(*host).tape.add(i));
        }
        let bad = |at: &*const c_void| match (*host).width {
            Width::F64 => !(*at.cast::<f64>()).is_finite(),
            Width::F32 => !(*at.cast::<f32>()).is_finite(),
        };
        let truth = match (*script).answer {
            Returned::None => false,
            Returned::Int(at) => *at != 0,
            Returned::Wide(at) => *at != 0.0,
            Returned::Narrow(at) => *at != 0.0,
        };
        i32::from(truth && !(*script).reals.iter().any(bad))
    }
}

/// The value of a statement, seconds, as nanoseconds.
unsafe extern "C" fn duration(net: *const Player, script: i32) -> i64 {
    // SAFETY: as for `act`.
    unsafe {
        act(net, script);
        let script: *const BareScript = (*(*net).host.cast::<Host>()).scripts.as_ptr().add(script as usize);
        match (*script).answer {
            Returned::None => 0,
            Returned::Int(at) => i64::from(*at).max(0).saturating_mul(1_000_000_000),
            Returned::Wide(at) => pcl2_net_nanoseconds(at),
            Returned::Narrow(at) => pcl2f_net_nanoseconds(at),
        }
    }
}

/// One scan of a net and of those in it, outer ones first. The first takes its inputs in here, the others are told to by
/// the player.
unsafe fn play(nets: *mut Player, count: i32, tape: &[Bare]) {
    // SAFETY: as for `Bound::run`; the nets stand one after the other, and each host lives in a box of its own.
    unsafe {
        let host = (*nets).host.cast::<Host>();
        for op in &tape[(*host).latch.clone()] {
            perform(op);
        }
        let mut now = (*nets).now;
        match (*host).width {
            Width::F64 => pcl2_net_scan(nets, count, &raw mut now, (*host).period),
            Width::F32 => pcl2f_net_scan(nets, count, &raw mut now, (*host).period),
        }
        (*nets).now = now;
    }
}

/// The lists of things to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tape {
    /// Int parameters of composites that inner blocks take as reals.
    Convert,
    /// Kernels' checks.
    Check,
    /// Kernels' tunes.
    Tune,
    /// Kernels' inits.
    Init,
    /// Declared initial outputs of variables with several writers.
    Publish,
    /// The blocks.
    Step,
    /// The statements of nets, which the player runs one by one.
    Script,
}

/// How many tapes there are.
pub(crate) const TAPES: usize = 7;

/// A program's storage and what to do with it, in places instead of pointers.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    /// Bytes of storage.
    pub(crate) bytes: usize,
    /// The arguments of all calls, one after the other.
    pub(crate) arguments: Vec<Slot>,
    /// The tapes, in the order of [`Tape`].
    pub(crate) tapes: [Vec<Op>; TAPES],
    /// The nets, each before those in it.
    pub(crate) nets: Vec<NetPlan>,
}

/// Why a plan cannot run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoRoom {
    /// There is not enough memory.
    Memory,
    /// A place lies outside the storage.
    Outside,
}

#[derive(Clone, Copy)]
enum Bare {
    Call(Thunk, *const *mut c_void),
    ConvertWide(*const i32, *mut f64),
    ConvertNarrow(*const i32, *mut f32),
    CopyWide(*const u64, *mut u64),
    Copy(*const u8, *mut u8, usize),
    JudgeWide(*const *mut c_void, usize, *mut i32),
    JudgeNarrow(*const *mut c_void, usize, *mut i32),
    Clear(*mut i32),
    Carry(*const i32, *mut i32),
    Fault(*const i32, u32),
    Net(usize, i32),
}

/// A plan with its storage.
pub(crate) struct Bound {
    words: Vec<Cell<u64>>,
    /// Read by the thunks.
    _pointers: Vec<*mut c_void>,
    tapes: [Vec<Bare>; TAPES],
    nets: *mut Player,
    /// What the nets point to.
    hosts: Vec<Host>,
}

impl Drop for Bound {
    fn drop(&mut self) {
        let nets = std::ptr::slice_from_raw_parts_mut(self.nets, self.hosts.len());
        // SAFETY: the pointer came from a box of this length in `Bound::join` and is dropped once.
        drop(unsafe { Box::from_raw(nets) });
    }
}

impl std::fmt::Debug for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Bound({} words)", self.words.len())
    }
}

impl Bound {
    /// Allocates zeroed storage and turns places into pointers.
    pub(crate) fn new(plan: &Plan, width: Width) -> Result<Bound, NoRoom> {
        let mut words = Vec::new();
        let count = plan.bytes.div_ceil(8);
        words.try_reserve_exact(count).map_err(|_| NoRoom::Memory)?;
        words.resize_with(count, || Cell::new(0_u64));
        let storage = Storage { base: words.as_ptr().cast::<u8>().cast_mut(), bytes: count * 8 };
        let pointers = plan.arguments.iter().map(|slot| storage.argument(*slot)).collect::<Result<Vec<_>, _>>()?;
        let mut tapes: [Vec<Bare>; TAPES] = Default::default();
        for (bare, ops) in tapes.iter_mut().zip(&plan.tapes) {
            *bare =
                ops.iter().map(|op| storage.bind(*op, &plan.arguments, &pointers, width)).collect::<Result<_, _>>()?;
        }
        let script = &tapes[Tape::Script as usize];
        let hosts: Vec<Host> =
            plan.nets.iter().map(|net| storage.host(net, script, width)).collect::<Result<_, _>>()?;
        let players = plan.nets.iter().zip(&hosts).map(|(net, host)| storage.player(net, host));
        let players = players.collect::<Result<_, _>>()?;
        let nets = join(players, plan)?;
        Ok(Bound { words, _pointers: pointers, tapes, nets, hosts })
    }

    /// How many things a tape has to do.
    pub(crate) fn len(&self, tape: Tape) -> usize {
        self.tapes[tape as usize].len()
    }

    /// Does a part of a tape. Faults of `scan` go into the health record.
    pub(crate) fn run(&self, tape: Tape, range: Range<usize>, scan: u32, health: &mut Health) {
        let Some(ops) = self.tapes[tape as usize].get(range) else {
            return;
        };
        for op in ops {
            // SAFETY: `bind` made every pointer from a checked range of `words` or, for a call, of `_pointers`,
            // which live as long as `self`. No `Cell` of `words` is accessed while C runs.
            unsafe {
                match op {
                    Bare::Fault(at, block) => {
                        if **at != 0 {
                            health.fault(FaultAt { block: *block, status: **at, scan });
                        }
                    }
                    Bare::Net(first, count) => {
                        play(self.nets.add(*first), *count, &self.tapes[Tape::Script as usize]);
                    }
                    other => perform(other),
                }
            }
        }
    }

    /// Four bytes of the storage.
    pub(crate) fn read4(&self, at: usize) -> [u8; 4] {
        let word = self.read8(at & !7);
        if at & 4 == 0 { [word[0], word[1], word[2], word[3]] } else { [word[4], word[5], word[6], word[7]] }
    }

    /// Eight bytes of the storage.
    pub(crate) fn read8(&self, at: usize) -> [u8; 8] {
        self.words.get(at / 8).map_or([0; 8], |word| word.get().to_ne_bytes())
    }

    /// Writes four bytes.
    pub(crate) fn write4(&self, at: usize, bytes: [u8; 4]) {
        let mut word = self.read8(at & !7);
        word[at & 4..(at & 4) + 4].copy_from_slice(&bytes);
        self.write8(at & !7, word);
    }

    /// Writes eight bytes.
    pub(crate) fn write8(&self, at: usize, bytes: [u8; 8]) {
        if let Some(word) = self.words.get(at / 8) {
            word.set(u64::from_ne_bytes(bytes));
        }
    }
}

/// Does one thing that tells nobody of faults.
unsafe fn perform(op: &Bare) {
    // SAFETY: as for `Bound::run`, the only caller beside those that it calls.
    unsafe {
        match *op {
            Bare::Call(thunk, arguments) => thunk(arguments),
            Bare::ConvertWide(from, to) => *to = f64::from(*from),
            Bare::ConvertNarrow(from, to) => *to = *from as f32,
            Bare::CopyWide(from, to) => *to = *from,
            Bare::Copy(from, to, bytes) => std::ptr::copy(from, to, bytes),
            Bare::JudgeWide(places, inputs, at) => {
                let bad = |i: usize| !(*(*places.add(i)).cast::<f64>()).is_finite();
                *at = i32::from(bad(inputs) && !(0..inputs).any(bad));
            }
            Bare::JudgeNarrow(places, inputs, at) => {
                let bad = |i: usize| !(*(*places.add(i)).cast::<f32>()).is_finite();
                *at = i32::from(bad(inputs) && !(0..inputs).any(bad));
            }
            Bare::Clear(at) => *at = 0,
            Bare::Carry(from, to) => {
                if *to == 0 {
                    *to = *from;
                }
            }
            Bare::Fault(..) | Bare::Net(..) => {}
        }
    }
}

/// Puts the nets one after the other and gives each the net around it.
fn join(players: Vec<Player>, plan: &Plan) -> Result<*mut Player, NoRoom> {
    let nets = Box::into_raw(players.into_boxed_slice()).cast::<Player>();
    for (i, net) in plan.nets.iter().enumerate() {
        let Some(outer) = net.outer else {
            continue;
        };
        if outer >= i {
            return Err(NoRoom::Outside);
        }
        // SAFETY: both stand in the box, which has as many nets as the plan.
        unsafe {
            (*nets.add(i)).outer = nets.add(outer);
        }
    }
    Ok(nets)
}

/// The allocation as C sees it.
#[derive(Clone, Copy)]
struct Storage {
    base: *mut u8,
    bytes: usize,
}

impl Storage {
    fn place<T>(self, at: usize, bytes: usize) -> Result<*mut T, NoRoom> {
        let inside = at.checked_add(bytes.max(size_of::<T>())).is_some_and(|end| end <= self.bytes);
        if !inside || at % align_of::<T>() != 0 {
            return Err(NoRoom::Outside);
        }
        // SAFETY: the offset lies inside the allocation.
        Ok(unsafe { self.base.add(at) }.cast())
    }

    fn argument(self, slot: Slot) -> Result<*mut c_void, NoRoom> {
        match slot.bytes {
            0 => Ok(std::ptr::null_mut()),
            bytes if slot.at % 4 == 0 => self.place::<u8>(slot.at, bytes).map(<*mut u8>::cast),
            _ => Err(NoRoom::Outside),
        }
    }

    /// The reals that a judgement reads: aligned, and at least the result.
    fn judged(
        self,
        first: usize,
        count: usize,
        slots: &[Slot],
        pointers: &[*mut c_void],
        width: Width,
    ) -> Result<(*const *mut c_void, usize), NoRoom> {
        let end = first.checked_add(count).ok_or(NoRoom::Outside)?;
        let (slots, places) = slots.get(first..end).zip(pointers.get(first..end)).ok_or(NoRoom::Outside)?;
        let inputs = count.checked_sub(1).ok_or(NoRoom::Outside)?;
        let one_real = |slot: &Slot| slot.bytes >= width.bytes() && slot.at % width.bytes() == 0;
        if slots.iter().all(one_real) { Ok((places.as_ptr(), inputs)) } else { Err(NoRoom::Outside) }
    }

    /// What a net's statements need.
    fn host(self, net: &NetPlan, tape: &[Bare], width: Width) -> Result<Host, NoRoom> {
        for at in net.words.iter().chain(&net.hands) {
            self.place::<i32>(*at, 4)?;
        }
        let mut scripts = Vec::with_capacity(net.scripts.len());
        for script in &net.scripts {
            scripts.push(self.script(script, tape.len(), width)?);
        }
        if net.latch.end > tape.len() {
            return Err(NoRoom::Outside);
        }
        Ok(Host {
            tape: tape.as_ptr(),
            scripts,
            latch: net.latch.clone(),
            period: net.period,
            width,
            table: net.table.clone(),
            words: net.words.clone(),
            hands: net.hands.clone(),
        })
    }

    /// A net as the player sees it; the net around it is filled in by `join`.
    fn player(self, net: &NetPlan, host: &Host) -> Result<Player, NoRoom> {
        let mut arrays = Vec::with_capacity(net.arrays.len());
        for slot in &net.arrays {
            arrays.push(self.place::<u64>(slot.at, slot.bytes.max(8)).map(<*mut u64>::cast::<c_void>)?);
        }
        if arrays.len() != ROW + MORE && arrays.len() != ROW + MORE + OPERATED {
            return Err(NoRoom::Outside);
        }
        let mut operated = [std::ptr::null_mut(); OPERATED];
        operated[..arrays.len() - ROW - MORE].copy_from_slice(&arrays[ROW + MORE..]);
        let mut row = [std::ptr::null_mut(); ROW];
        row.copy_from_slice(&arrays[..ROW]);
        Ok(Player {
            table: host.table.as_ptr(),
            base: self.base,
            arrays: row,
            words: host.words.as_ptr(),
            hands: host.hands.as_ptr(),
            wrote: arrays[ROW],
            active: arrays[ROW + 1],
            active_since: arrays[ROW + 2],
            outer: std::ptr::null_mut(),
            inputs: net.inputs,
            now: 0,
            mode: 0,
            blocked: 0,
            switched: 0,
            status: self.place(net.status, 4)?,
            lost: arrays[ROW + 3],
            conflicts: arrays[ROW + 4],
            operated,
            act,
            duration,
            host: std::ptr::from_ref(host).cast(),
        })
    }

    fn script(self, script: &Script, tape: usize, width: Width) -> Result<BareScript, NoRoom> {
        if script.ops.end > tape {
            return Err(NoRoom::Outside);
        }
        let answer = match (script.answer, width) {
            (Answer::None, _) => Returned::None,
            (Answer::Int(at), _) => Returned::Int(self.place(at, 4)?),
            (Answer::Real(at), Width::F64) => Returned::Wide(self.place(at, 8)?),
            (Answer::Real(at), Width::F32) => Returned::Narrow(self.place(at, 4)?),
        };
        let reals =
            script.reals.iter().map(|at| self.place::<u32>(*at, width.bytes()).map(|at| at.cast_const().cast()));
        Ok(BareScript { ops: script.ops.clone(), answer, reals: reals.collect::<Result<_, _>>()? })
    }

    fn bind(self, op: Op, slots: &[Slot], pointers: &[*mut c_void], width: Width) -> Result<Bare, NoRoom> {
        Ok(match op {
            Op::Call { function: Function(thunk), first, count } => {
                let end = first.checked_add(count).ok_or(NoRoom::Outside)?;
                Bare::Call(thunk, pointers.get(first..end).ok_or(NoRoom::Outside)?.as_ptr())
            }
            Op::Judge { first, count, at } => {
                let at = self.place(at, 4)?;
                let (places, inputs) = self.judged(first, count, slots, pointers, width)?;
                match width {
                    Width::F64 => Bare::JudgeWide(places, inputs, at),
                    Width::F32 => Bare::JudgeNarrow(places, inputs, at),
                }
            }
            Op::Convert { from, to } => match width {
                Width::F64 => Bare::ConvertWide(self.place(from, 4)?, self.place(to, 8)?),
                Width::F32 => Bare::ConvertNarrow(self.place(from, 4)?, self.place(to, 4)?),
            },
            Op::Copy { from, to, bytes: 8 } if from % 8 == 0 && to % 8 == 0 => {
                Bare::CopyWide(self.place(from, 8)?, self.place(to, 8)?)
            }
            Op::Copy { from, to, bytes } => Bare::Copy(self.place(from, bytes)?, self.place(to, bytes)?, bytes),
            Op::Clear { at } => Bare::Clear(self.place(at, 4)?),
            Op::Carry { from, to } => Bare::Carry(self.place(from, 4)?, self.place(to, 4)?),
            Op::Fault { at, block } => Bare::Fault(self.place(at, 4)?, block),
            Op::Net { first, count } => Bare::Net(first, i32::try_from(count).map_err(|_| NoRoom::Outside)?),
        })
    }
}
