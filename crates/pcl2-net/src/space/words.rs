//! Packed markings of a length that the compiler knows, for the common small nets, or does not.

/// The words of a packed marking.
pub(super) trait Words: Clone {
    /// Its length, given the length at run time.
    fn length(length: usize) -> usize;
    /// All zeros.
    fn zeros(length: usize) -> Self;
    /// The words.
    fn words(&self) -> &[u64];
    /// The words, to be written.
    fn words_mut(&mut self) -> &mut [u64];
}

impl<const N: usize> Words for [u64; N] {
    #[inline(always)]
    fn length(_: usize) -> usize {
        N
    }

    #[inline(always)]
    fn zeros(_: usize) -> Self {
        [0; N]
    }

    #[inline(always)]
    fn words(&self) -> &[u64] {
        self
    }

    #[inline(always)]
    fn words_mut(&mut self) -> &mut [u64] {
        self
    }
}

impl Words for Vec<u64> {
    #[inline]
    fn length(length: usize) -> usize {
        length
    }

    fn zeros(length: usize) -> Self {
        vec![0; length]
    }

    #[inline]
    fn words(&self) -> &[u64] {
        self
    }

    #[inline]
    fn words_mut(&mut self) -> &mut [u64] {
        self
    }
}

/// The borrows out of each bit of a - b. Fields of packed numbers are compared all at once: some field of a is less than
/// its field of b exactly if there is a borrow out of the top bit of some field. (The lowest such field borrows for
/// sure; what it does to the fields above does not matter then.)
#[inline(always)]
pub(super) fn borrows(a: u64, b: u64) -> u64 {
    (!a & b) | ((!a | b) & a.wrapping_sub(b))
}
