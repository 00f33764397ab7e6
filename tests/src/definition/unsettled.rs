//! What is not settled: the page and the player do not say the same, or the page says nothing.
//!
//! A run in which one of these comes up proves nothing from there on. What gets settled is taken out here, and where the
//! compiler then complains.

/// Something that is not settled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unsettled {
    /// A time that is bad. Of conditions the page says that a bad operand makes them not true; of times it says nothing, and the
    /// player lets a time that is no number be over at once.
    BadTime,
    /// An edge of a GENERATE box in the very scan in which the one before gets its room. By the page an edge is lost without
    /// room; the player loses it.
    EdgeAfterRoom,
    /// An output that is written, counted on and written again in one scan. The page compares the two writes, the player the
    /// second with what stands there.
    WriteAfterCount,
    /// An ABORT of a macro in a macro that an ABORT has just emptied: the player leaves its token inside.
    AbortInside,
    /// A READ box with attributes of which another gate took a token in this scan. By the page a gate works on the marking at
    /// the start of the phase; the player does not try such tokens.
    ReadOfTaken,
    /// A condition over attributes of a macro's token: the player reads the token that entered, and takes the one at the exit.
    TokenOfMacro,
    /// A gate before and after which a macro stands, while more than its exit is marked inside. By the page no token enters;
    /// the player's does.
    EntryBesideOthers,
    /// A box phase that asks for the tokens of a GENERATE box which made one in it. By the page it is their number at the start
    /// of the phase, in the player the number now.
    NewToken,
    /// A command in the first scan after a stop, which the player neither obeys nor refuses.
    CommandAfterStop,
    /// A command that is read after a gate cleared it. By the page inputs stay until the end of the scan; the player shows 0.
    ClearedCommand,
    /// An attribute of a box without a token, of which the page says nothing. In the player it is 0.
    EmptyBox,
    /// An attribute of a box whose first token a gate has just taken. By the page it is that of the first token at the start of
    /// the phase, in the player that of the first one left.
    FirstIsTaken,
    /// A statement over the token that a gate takes from a box into which it puts another one. By the page it is the token
    /// taken; the player writes to the one put.
    Replaced,
    /// An attribute of a macro from which the gate takes nothing: of the token that entered, or of the one at the exit.
    MacroFromAfar,
    /// A net inside that has its own MODE and goes on while the net around it is stopped. The page: written outputs are then
    /// what they were before the stop; in the player, what the net inside wrote.
    WrittenMeanwhile,
}
