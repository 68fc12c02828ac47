//! Sets of classes, a bit each.

/// Some of a library's classes, by index.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ClassSet(Box<[u64]>);

impl ClassSet {
    /// No class of `n`.
    pub fn none(n: usize) -> Self {
        Self(vec![0; n.div_ceil(64)].into())
    }

    /// All `n` classes.
    pub fn all(n: usize) -> Self {
        let mut set = Self::none(n);
        (0..n).for_each(|class| set.insert(class));
        set
    }

    /// Adds a class.
    pub fn insert(&mut self, class: usize) {
        self.0[class / 64] |= 1 << (class % 64);
    }

    /// Whether a class is among them.
    pub fn contains(&self, class: usize) -> bool {
        self.0[class / 64] & (1 << (class % 64)) != 0
    }

    /// Those that are in both.
    pub fn and(&self, other: &Self) -> Self {
        self.merged(other, |a, b| a & b)
    }

    /// Those that are not in the other.
    pub fn without(&self, other: &Self) -> Self {
        self.merged(other, |a, b| a & !b)
    }

    /// How many are in both.
    pub fn in_common(&self, other: &Self) -> usize {
        let both = self.0.iter().zip(&other.0).map(|(a, b)| a & b);
        both.map(|word| word.count_ones() as usize).sum()
    }

    /// Whether all of them are in the other.
    pub fn is_within(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(a, b)| a & !b == 0)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }

    /// The classes in order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().enumerate().flat_map(|(k, word)| {
            let mut left = *word;
            std::iter::from_fn(move || {
                (left != 0).then(|| {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    64 * k + bit
                })
            })
        })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    fn merged(&self, other: &Self, merge: impl Fn(u64, u64) -> u64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| merge(*a, *b)).collect())
    }
}
