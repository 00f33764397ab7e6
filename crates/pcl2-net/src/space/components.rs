//! The strongly connected components of the reachable markings, as far as liveness needs them: those that no move leaves.

use super::markings::Batch;
use super::moves::{Halt, Moves};
use super::search::{Found, STRIDE, load};
use super::words::Words;

/// What the bottom components tell: from every reachable marking one of them is reached, and never left again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Bottoms {
    /// How many there are, if they were counted.
    pub(super) count: Option<u64>,
    /// By transition: whether it fires in each of them.
    pub(super) live: Vec<bool>,
    /// The initial marking is in one, so that every marking leads back to it.
    pub(super) reversible: bool,
}

/// Finds the bottom components (Tarjan's algorithm, with a stack of its own). All markings must have been found.
pub(super) fn bottoms<K: Words, F: Words>(
    found: &Found,
    moves: &mut impl Moves,
    progress: &mut dyn FnMut(u64),
) -> Result<Bottoms, Halt> {
    let bottoms = Bottoms { count: Some(0), live: vec![true; found.fired.len()], reversible: false };
    let mut search = Search {
        found,
        successors: Successors { found, moves, from: F::zeros(found.layout.words), batch: Batch::default() },
        order: vec![0; found.markings.count() + 1],
        entered: 0,
        open: Vec::new(),
        frames: Vec::new(),
        bottoms,
    };
    search.enter(1);
    let mut list = Vec::new();
    while let Some(frame) = search.frames.last().copied() {
        list.clear();
        search.successors.of::<K>(frame.marking, &mut list)?;
        if !search.descend(&list) {
            search.leave::<K>()?;
            if search.entered as usize % STRIDE == 0 {
                progress(u64::from(search.entered));
            }
        }
    }
    Ok(search.bottoms)
}

/// A marking on the way.
#[derive(Clone, Copy, Debug)]
struct Frame {
    marking: u32,
    /// The next of its moves.
    next: u32,
    /// The earliest open marking that it is known to reach.
    low: u32,
    /// A move leads out of its component.
    leaves: bool,
}

/// The order of a marking whose component is done.
const DONE: u32 = u32::MAX;

struct Search<'a, M, F> {
    found: &'a Found,
    successors: Successors<'a, M, F>,
    /// By marking: when it was entered, from 1; 0: not yet.
    order: Vec<u32>,
    entered: u32,
    /// Markings whose component is not done.
    open: Vec<u32>,
    frames: Vec<Frame>,
    bottoms: Bottoms,
}

impl<M: Moves, F: Words> Search<'_, M, F> {
    fn enter(&mut self, marking: u32) {
        self.entered += 1;
        self.order[marking as usize] = self.entered;
        self.open.push(marking);
        self.frames.push(Frame { marking, next: 0, low: self.entered, leaves: false });
    }

    /// Looks at the rest of the last frame's moves, up to the first that leads to a new marking. Whether there is one.
    fn descend(&mut self, successors: &[u32]) -> bool {
        let Some(frame) = self.frames.last_mut() else { return false };
        for successor in successors.iter().skip(frame.next as usize) {
            frame.next += 1;
            match self.order[*successor as usize] {
                0 => {
                    self.enter(*successor);
                    return true;
                }
                DONE => frame.leaves = true,
                order => frame.low = frame.low.min(order),
            }
        }
        false
    }

    /// Takes away the last frame, and its component if it was entered there.
    fn leave<K: Words>(&mut self) -> Result<(), Halt> {
        let Some(frame) = self.frames.pop() else { return Ok(()) };
        let is_root = frame.low == self.order[frame.marking as usize];
        if let Some(parent) = self.frames.last_mut() {
            parent.leaves |= is_root || frame.leaves;
            parent.low = parent.low.min(frame.low);
        }
        if is_root {
            let first = self.open.iter().rposition(|open| *open == frame.marking).unwrap_or(0);
            let members = self.open.split_off(first);
            members.iter().for_each(|member| self.order[*member as usize] = DONE);
            if !frame.leaves {
                self.close::<K>(&members)?;
            }
        }
        Ok(())
    }

    /// Notes a bottom component.
    fn close<K: Words>(&mut self, members: &[u32]) -> Result<(), Halt> {
        let mut fired = vec![false; self.found.fired.len()];
        for member in members {
            self.successors.fired::<K>(*member, &mut fired)?;
        }
        self.bottoms.count = self.bottoms.count.map(|count| count + 1);
        self.bottoms.live.iter_mut().zip(fired).for_each(|(live, fired)| *live &= fired);
        self.bottoms.reversible |= members.first() == Some(&1);
        Ok(())
    }
}

/// Finds the moves of markings again.
struct Successors<'a, M, F> {
    found: &'a Found,
    moves: &'a mut M,
    from: F,
    batch: Batch,
}

impl<M: Moves, F: Words> Successors<'_, M, F> {
    /// The numbers of the markings that follow.
    fn of<K: Words>(&mut self, marking: u32, numbers: &mut Vec<u32>) -> Result<(), Halt> {
        let Successors { found, moves, from, batch } = self;
        load::<K, F>(&found.markings, &found.layout, marking as usize, from);
        moves.each::<K, F>(from, 0, &mut |key, _, _| {
            batch.push(key, 0);
            Ok(())
        })?;
        found.markings.numbers::<K>(batch, numbers);
        Ok(())
    }

    /// Notes what fires.
    fn fired<K: Words>(&mut self, marking: u32, fired: &mut [bool]) -> Result<(), Halt> {
        load::<K, F>(&self.found.markings, &self.found.layout, marking as usize, &mut self.from);
        self.moves.each::<K, F>(&self.from, 0, &mut |_, transitions, _| {
            transitions.iter().for_each(|transition| fired[*transition as usize] = true);
            Ok(())
        })?;
        Ok(())
    }
}
