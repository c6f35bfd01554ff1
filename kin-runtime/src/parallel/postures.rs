//! The answer of a mechanism's inverse kinematics, chain by chain.

use crate::{JointLimit, Solutions, math};

/// No chain with a closed form has more solutions.
const CAPACITY: usize = Solutions::<1>::CAPACITY;

/// All configurations of N joints in K chains that hold the platform in one
/// place. Once that place is known, the chains do not know of each other, and
/// every combination of their solutions is a configuration: a Stewart platform
/// has thousands, of which the list holds the factors alone.
///
/// ```
/// use kin_runtime::{JointLimit, Postures};
/// // Two chains of one and two joints, with two solutions each.
/// let mut postures = Postures::<3, 2>::new([[0, 1], [1, 3]]);
/// for x in [-0.5, 0.5] {
///     postures.push(0, 0, &[x]);
///     postures.push(1, 0, &[x, 2.0 * x]);
/// }
/// assert_eq!(postures.len(), 4);
/// let limits = [JointLimit::Continuous; 3];
/// assert_eq!(postures.nearest(&[-0.4, 0.6, 0.8], &limits), Some([-0.5, 0.5, 1.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Postures<const N: usize, const K: usize> {
    chains: [[usize; 2]; K],
    /// Row b has the b-th solution of every chain.
    q: [[f64; N]; CAPACITY],
    /// The platform pose that the b-th solution of chain k is for.
    places: [[u8; CAPACITY]; K],
    counts: [usize; K],
}

impl<const N: usize, const K: usize> Postures<N, K> {
    /// None yet. `chains` are the first joint of every chain, and one past its
    /// last.
    pub fn new(chains: [[usize; 2]; K]) -> Self {
        Postures {
            chains,
            q: [[0.0; N]; CAPACITY],
            places: [[0; CAPACITY]; K],
            counts: [0; K],
        }
    }

    /// Adds a solution of one chain, with the platform in the given of several
    /// places: solutions combine where their places agree. Beyond 16 of one
    /// chain nothing is added.
    ///
    /// # Panics
    /// If there is no such chain, or it has not as many joints as `values`.
    pub fn push(&mut self, chain: usize, place: u8, values: &[f64]) {
        let [first, end] = self.chains[chain];
        let b = self.counts[chain];
        if b < CAPACITY {
            self.q[b][first..end].copy_from_slice(values);
            self.places[chain][b] = place;
            self.counts[chain] += 1;
        }
    }

    /// Ends the solutions for a place, which are the last ones: where some chain has none there, those
    /// of the others combine with nothing, and leave their room to those for other places.
    ///
    /// ```
    /// use kin_runtime::Postures;
    /// let mut postures = Postures::<2, 2>::new([[0, 1], [1, 2]]);
    /// for place in 0..3 {
    ///     (0..8).for_each(|x| postures.push(0, place, &[f64::from(x)]));
    ///     if place == 2 {
    ///         postures.push(1, place, &[0.5]);
    ///     }
    ///     postures.end_place(place);
    /// }
    /// assert_eq!(postures.len(), 8);
    /// ```
    pub fn end_place(&mut self, place: u8) {
        if self.in_place(place) > 0 {
            return;
        }
        for (count, places) in self.counts.iter_mut().zip(&self.places) {
            while *count > 0 && places[*count - 1] == place {
                *count -= 1;
            }
        }
    }

    /// The solutions of one chain: the values of its joints.
    pub fn of_chain(&self, chain: usize) -> impl Iterator<Item = &[f64]> {
        let [first, end] = self.chains[chain];
        self.q[..self.counts[chain]]
            .iter()
            .map(move |row| &row[first..end])
    }

    /// How many configurations there are; the largest number of its type if there are more.
    pub fn len(&self) -> usize {
        let all = self.all_places().map(|place| self.in_place(place));
        all.fold(0, usize::saturating_add)
    }

    /// How many there are with the platform in one place.
    fn in_place(&self, place: u8) -> usize {
        let counts = (0..K).map(|k| self.at(k, place).count());
        // Of the others, if one has none.
        counts.clone().min().map_or(0, |least| match least {
            0 => 0,
            _ => counts.fold(1, usize::saturating_mul),
        })
    }

    /// Whether the platform cannot be held there.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All configurations, one by one, as many as [`Postures::len`] counts.
    pub fn iter(&self) -> impl Iterator<Item = [f64; N]> {
        self.all_places().flat_map(move |place| {
            let counts: [usize; K] = core::array::from_fn(|k| self.at(k, place).count());
            (0..self.in_place(place)).map(move |number: usize| {
                let mut rest = number;
                let mut q = [0.0; N];
                for (k, &[first, end]) in self.chains.iter().enumerate() {
                    let b = self.at(k, place).nth(rest % counts[k]).unwrap_or(0);
                    q[first..end].copy_from_slice(&self.q[b][first..end]);
                    rest /= counts[k];
                }
                q
            })
        })
    }

    /// Keeps the solutions of chains that `keep` says to.
    pub fn retain(&mut self, keep: impl Fn(usize, &[f64]) -> bool) {
        for (k, &[first, end]) in self.chains.iter().enumerate() {
            let mut kept = 0;
            for b in 0..self.counts[k] {
                if keep(k, &self.q[b][first..end]) {
                    let row = self.q[b];
                    self.q[kept][first..end].copy_from_slice(&row[first..end]);
                    self.places[k][kept] = self.places[k][b];
                    kept += 1;
                }
            }
            self.counts[k] = kept;
        }
    }

    /// Keeps the solutions in which a joint has some value, to within 1e-6, and of two that do, as next
    /// to where a chain is stretched, the nearer; `turns` where that is an angle.
    ///
    /// ```
    /// use kin_runtime::Postures;
    /// let mut postures = Postures::<1, 1>::new([[0, 1]]);
    /// [0.5, 0.500_000_4].map(|x| postures.push(0, 0, &[x]));
    /// postures.keep(0, 0.5, true);
    /// assert!(postures.iter().eq([[0.5]]));
    /// ```
    pub fn keep(&mut self, joint: usize, value: f64, turns: bool) {
        let holds = |[first, end]: &[usize; 2]| (*first..*end).contains(&joint);
        let Some(chain) = self.chains.iter().position(holds) else {
            return;
        };
        let place = joint - self.chains[chain][0];
        let apart = |values: &[f64]| {
            let apart = values[place] - value;
            math::select(turns, math::wrap(apart), apart).abs()
        };
        let nearest = self
            .of_chain(chain)
            .map(apart)
            .fold(f64::INFINITY, f64::min);
        // Rounding parts those that have the same value.
        let most = (nearest + 1e-9).min(1e-6);
        self.retain(|k, values| k != chain || apart(values) < most);
    }

    /// The configuration that is nearest to `seed` inside the limits, each
    /// chain by itself: least Euclidean norm of the differences, radians and
    /// metres, every joint wound as near to `seed` as its limits allow.
    pub fn nearest(&self, seed: &[f64; N], limits: &[JointLimit; N]) -> Option<[f64; N]> {
        let mut best = None;
        let mut least = f64::INFINITY;
        for place in self.all_places() {
            if let Some((q, distance)) = self.nearest_in(place, seed, limits)
                && distance < least
            {
                (best, least) = (Some(q), distance);
            }
        }
        best
    }

    fn nearest_in(
        &self,
        place: u8,
        seed: &[f64; N],
        limits: &[JointLimit; N],
    ) -> Option<([f64; N], f64)> {
        let (mut q, mut total) = ([0.0; N], 0.0);
        for (k, &[first, end]) in self.chains.iter().enumerate() {
            let mut least = f64::INFINITY;
            for b in self.at(k, place) {
                let mut wound = self.q[b];
                let mut distance = 0.0;
                for j in first..end {
                    match limits[j].nearest(wound[j], seed[j]) {
                        Some(value) => wound[j] = value,
                        None => distance = f64::INFINITY,
                    }
                    distance += (wound[j] - seed[j]) * (wound[j] - seed[j]);
                }
                if distance < least {
                    least = distance;
                    q[first..end].copy_from_slice(&wound[first..end]);
                }
            }
            total += least;
        }
        total.is_finite().then_some((q, total))
    }

    /// The solutions of a chain for one place, by number.
    fn at(&self, chain: usize, place: u8) -> impl Iterator<Item = usize> {
        (0..self.counts[chain]).filter(move |&b| self.places[chain][b] == place)
    }

    fn all_places(&self) -> core::ops::RangeInclusive<u8> {
        let used = (0..K).flat_map(|k| &self.places[k][..self.counts[k]]);
        0..=used.copied().max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two places, of which the second chain reaches only one.
    fn postures() -> Postures<3, 2> {
        let mut postures = Postures::new([[0, 2], [2, 3]]);
        postures.push(0, 0, &[1.0, 2.0]);
        postures.push(0, 1, &[3.0, 4.0]);
        postures.push(0, 1, &[5.0, 6.0]);
        postures.push(1, 1, &[7.0]);
        postures
    }

    #[test]
    fn only_solutions_for_one_place_combine() {
        let postures = postures();
        assert_eq!(postures.len(), 2);
        assert!(postures.iter().eq([[3.0, 4.0, 7.0], [5.0, 6.0, 7.0]]));
    }

    /// 8²⁴ = 2⁷².
    #[test]
    fn more_than_can_be_counted_are_not_none() {
        let mut postures = Postures::<24, 24>::new(core::array::from_fn(|k| [k, k + 1]));
        for (chain, value) in (0..24).flat_map(|k| (0..8).map(move |b| (k, f64::from(b)))) {
            postures.push(chain, 0, &[value]);
        }
        assert_eq!(postures.len(), usize::MAX);
        assert!(!postures.is_empty());
        assert_eq!(postures.iter().nth(9).unwrap()[..3], [1.0, 1.0, 0.0]);
        postures.retain(|chain, _| chain != 23);
        assert!(postures.is_empty() && postures.iter().next().is_none());
    }

    #[test]
    fn what_is_not_kept_combines_no_more() {
        let mut postures = postures();
        postures.retain(|chain, values| chain == 1 || values[0] != 3.0);
        assert!(postures.iter().eq([[5.0, 6.0, 7.0]]));
        postures.retain(|chain, _| chain == 0);
        assert!(postures.is_empty());
    }

    #[test]
    fn the_nearest_obeys_limits_and_places() {
        let limit = JointLimit::Prismatic {
            lower: 0.0,
            upper: 8.0,
        };
        let near_first = [1.0, 2.0, 7.0];
        assert_eq!(
            postures().nearest(&near_first, &[limit; 3]),
            Some([3.0, 4.0, 7.0])
        );
        let short = JointLimit::Prismatic {
            lower: 0.0,
            upper: 6.5,
        };
        assert_eq!(postures().nearest(&near_first, &[short; 3]), None);
    }
}
