//! The markings that were found, each once, and the way from a marking to its number.
//!
//! Keys stand one behind the other in order of discovery. Numbers count from 1; the key of number 0 is only a place to
//! look at. A table with open addressing has one 32-bit entry for each number: as many bits as the table's size needs are
//! the number, the others are bits of the hash, so that a key is hardly ever compared in vain. Keys are looked up many at
//! once: first all their entries are read, then all the keys that those point to, so that the processor waits for many
//! lines of memory at the same time.

use super::layout::Layout;
use super::words::Words;
use std::collections::VecDeque;

/// Keys that are looked up together.
pub(super) const TOGETHER: usize = 64;

/// The size of the first table, as a power of two.
const FIRST: u32 = 10;

/// The size of the largest table.
const LAST: u32 = 31;

/// The most markings: three quarters of the largest table.
pub(super) const MOST_MARKINGS: usize = 3 << (LAST - 2);

/// The markings that were found.
#[derive(Clone, Debug)]
pub(super) struct Markings {
    keys: Vec<u64>,
    stride: usize,
    count: usize,
    table: Vec<u32>,
    /// The table's size is two to this.
    bits: u32,
}

/// Keys that wait to be looked up.
#[derive(Clone, Debug, Default)]
pub(super) struct Batch {
    keys: Vec<u64>,
    hashes: Vec<u32>,
    /// By key: what goes along with it.
    skips: Vec<u64>,
    entries: Vec<u32>,
    slots: Vec<u32>,
}

impl Batch {
    /// Adds a key.
    #[inline(always)]
    pub(super) fn push(&mut self, key: &[u64], skip: u64) {
        self.keys.extend_from_slice(key);
        self.skips.push(skip);
        self.hashes.push(hash(key));
    }

    /// How many wait.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.hashes.len()
    }

    #[inline(always)]
    fn key<K: Words>(&self, at: usize, stride: usize) -> &[u64] {
        let stride = K::length(stride);
        &self.keys[at * stride..][..stride]
    }

    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.keys.clear();
        self.hashes.clear();
        self.skips.clear();
    }
}

/// The upper half of a product has something of every bit.
#[inline(always)]
fn hash(key: &[u64]) -> u32 {
    let mut hash = 0_u64;
    for word in key {
        hash = (hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash ^= hash >> 32;
    }
    (hash.wrapping_mul(0xd6e8_feb8_6659_fd93) >> 32) as u32
}

impl Markings {
    /// No marking yet; keys of so many words.
    pub(super) fn new(stride: usize) -> Markings {
        Markings { keys: vec![0; stride], stride, count: 0, table: vec![0; 1 << FIRST], bits: FIRST }
    }

    /// How many there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The key with a number.
    #[inline(always)]
    pub(super) fn key<K: Words>(&self, number: usize) -> &[u64] {
        let stride = K::length(self.stride);
        &self.keys[number * stride..][..stride]
    }

    /// Takes up the keys that are new, up to a number of markings. Whether all were taken up.
    pub(super) fn insert<K: Words>(&mut self, batch: &mut Batch, limit: usize, fresh: &mut VecDeque<u64>) -> bool {
        self.make_room(batch.len());
        self.look_up::<K>(batch);
        let mut all = true;
        for at in 0..batch.len() {
            if batch.entries[at] == 0 {
                let before = self.count;
                all &= self.insert_one::<K>(batch, at, limit);
                if self.count > before {
                    fresh.push_back(batch.skips[at]);
                }
            }
        }
        batch.clear();
        all
    }

    /// The numbers of the keys that wait, in their order; 0 of one that was not found. Forgets the keys.
    pub(super) fn numbers<K: Words>(&self, batch: &mut Batch, numbers: &mut Vec<u32>) {
        self.look_up::<K>(batch);
        for at in 0..batch.len() {
            let number = match batch.entries[at] {
                0 => self.search::<K>(batch.key::<K>(at, self.stride), batch.hashes[at], batch.slots[at] as usize).0,
                number => number,
            };
            numbers.push(number);
        }
        batch.clear();
    }

    /// Finds most keys: their numbers, and where the search for the others goes on.
    #[inline(always)]
    fn look_up<K: Words>(&self, batch: &mut Batch) {
        let (bits, number_mask, slot_mask) = (self.bits, self.number_mask(), self.number_mask());
        batch.entries.clear();
        batch.slots.clear();
        for hash in &batch.hashes {
            let slot = self.slot(*hash);
            batch.slots.push(slot as u32);
            batch.entries.push(self.table[slot]);
        }
        let places = batch.entries.iter_mut().zip(&mut batch.slots).zip(&batch.hashes);
        for ((entry, slot), hash) in places {
            let tag = hash.wrapping_shl(bits);
            while *entry != 0 && (*entry ^ tag) >> bits != 0 {
                *slot = (*slot + 1) & slot_mask;
                *entry = self.table[*slot as usize];
            }
            *entry &= number_mask;
        }
        for at in 0..batch.hashes.len() {
            let number = batch.entries[at];
            let same = self.key::<K>(number as usize) == batch.key::<K>(at, self.stride);
            batch.entries[at] = if same { number } else { 0 };
        }
    }

    /// Goes on from a slot: the key's number, or 0 and the slot that it would take.
    fn search<K: Words>(&self, key: &[u64], hash: u32, mut slot: usize) -> (u32, usize) {
        let tag = hash.wrapping_shl(self.bits);
        loop {
            let entry = self.table[slot];
            let number = entry & self.number_mask();
            if entry == 0 || (entry ^ tag) >> self.bits == 0 && self.key::<K>(number as usize) == key {
                return (number, slot);
            }
            slot = (slot + 1) & (self.table.len() - 1);
        }
    }

    /// Takes up a key unless it is there; whether there was room for it.
    fn insert_one<K: Words>(&mut self, batch: &Batch, at: usize, limit: usize) -> bool {
        let (key, hash) = (batch.key::<K>(at, self.stride), batch.hashes[at]);
        let (known, slot) = self.search::<K>(key, hash, batch.slots[at] as usize);
        if known != 0 {
            return true;
        }
        if self.count >= limit {
            return false;
        }
        self.count += 1;
        self.keys.extend_from_slice(key);
        self.table[slot] = hash.wrapping_shl(self.bits) | self.count as u32;
        true
    }

    /// Holds the table at most three quarters full.
    fn make_room(&mut self, more: usize) {
        let mut bits = self.bits;
        while bits < LAST && self.count() + more >= 3 << (bits - 2) {
            bits += 1;
        }
        if bits != self.bits {
            self.bits = bits;
            self.fill_table();
        }
    }

    /// Makes the table anew from the keys.
    fn fill_table(&mut self) {
        // The old one goes first.
        self.table = Vec::new();
        self.table = vec![0; 1 << self.bits];
        let mask = self.table.len() - 1;
        for (number, key) in (0_u32..).zip(self.keys.chunks_exact(self.stride)).skip(1) {
            let hash = hash(key);
            let mut slot = self.slot(hash);
            while self.table[slot] != 0 {
                slot = (slot + 1) & mask;
            }
            self.table[slot] = hash.wrapping_shl(self.bits) | number;
        }
    }

    /// Packs all keys anew after some fields became wider.
    pub(super) fn repack(&mut self, old: &Layout, new: &Layout) {
        let (mut marking, mut full) = (vec![0; new.fields.len()], vec![0; old.words]);
        let count = self.count();
        self.table = Vec::new();
        self.keys.resize((count + 1) * old.key.max(new.key), 0);
        for step in 0..=count {
            // In place, so from the end on which nothing is written over before it is read.
            let number = if new.key > old.key { count - step } else { step };
            full[..old.key].copy_from_slice(&self.keys[number * old.key..][..old.key]);
            old.complete(&mut full);
            old.unpack(&full, &mut marking);
            new.pack(&marking, &mut self.keys[number * new.key..][..new.key]);
        }
        self.keys.truncate((count + 1) * new.key);
        self.stride = new.key;
        self.fill_table();
    }

    #[inline(always)]
    fn number_mask(&self) -> u32 {
        (1_u32 << self.bits) - 1
    }

    #[inline(always)]
    fn slot(&self, hash: u32) -> usize {
        (hash >> (u32::BITS - self.bits)) as usize
    }
}
