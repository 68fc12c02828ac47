//! The least number of views that cover a share of the samples: exact, by
//! branch and bound. A planner cannot do better on the same candidates.

/// The fewest views whose union covers at least `share` of the samples, in
/// ascending order. `seen[v][s]`: view v covers sample s. `None` where all
/// views together do not.
///
/// The search is exact. Views are tried by gain; a branch is cut when the
/// largest remaining gains cannot reach the share (gains only shrink).
pub fn least_views(seen: &[Vec<bool>], share: f64) -> Option<Vec<usize>> {
    let samples = seen.first().map_or(0, Vec::len);
    let needed = (share * samples as f64 - 1e-9).ceil().max(0.0) as u32;
    let rows: Vec<Vec<u64>> = seen.iter().map(|view| pack(view)).collect();
    let all = rows.iter().fold(vec![0; samples.div_ceil(64)], |a, r| union(&a, r));
    if ones(&all) < needed {
        return None;
    }
    let empty = vec![0; samples.div_ceil(64)];
    (0..=rows.len()).find_map(|most| {
        let open: Vec<usize> = (0..rows.len()).collect();
        let mut chosen = extend(&rows, &empty, &open, most, needed)?;
        chosen.sort_unstable();
        Some(chosen)
    })
}

/// At most `most` views out of `open` that bring `covered` up to `needed`.
fn extend(rows: &[Vec<u64>], covered: &[u64], open: &[usize], most: usize, needed: u32) -> Option<Vec<usize>> {
    let have = ones(covered);
    if have >= needed {
        return Some(Vec::new());
    }
    if most == 0 {
        return None;
    }
    let mut gains: Vec<(u32, usize)> = open.iter().map(|&v| (gain(covered, &rows[v]), v)).collect();
    gains.sort_by_key(|&(gain, v)| (std::cmp::Reverse(gain), v));
    for k in 0..gains.len() {
        let best: u32 = gains[k..].iter().take(most).map(|g| g.0).sum();
        if have + best < needed {
            return None;
        }
        let view = gains[k].1;
        let rest: Vec<usize> = gains[k + 1..].iter().map(|g| g.1).collect();
        if let Some(mut chosen) = extend(rows, &union(covered, &rows[view]), &rest, most - 1, needed) {
            chosen.push(view);
            return Some(chosen);
        }
    }
    None
}

fn pack(view: &[bool]) -> Vec<u64> {
    view.chunks(64)
        .map(|bits| bits.iter().enumerate().fold(0, |w, (k, &b)| w | u64::from(b) << k))
        .collect()
}

fn union(a: &[u64], b: &[u64]) -> Vec<u64> {
    a.iter().zip(b).map(|(x, y)| x | y).collect()
}

fn ones(a: &[u64]) -> u32 {
    a.iter().map(|w| w.count_ones()).sum()
}

fn gain(covered: &[u64], row: &[u64]) -> u32 {
    covered.iter().zip(row).map(|(c, r)| (r & !c).count_ones()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(sets: &[&[usize]], n: usize) -> Vec<Vec<bool>> {
        sets.iter().map(|s| (0..n).map(|k| s.contains(&k)).collect()).collect()
    }

    #[test]
    fn the_greedy_choice_is_not_always_in_the_least_cover() {
        let views = rows(&[&[0, 1, 2, 3], &[0, 1, 4], &[2, 3, 5]], 6);
        assert_eq!(least_views(&views, 1.0), Some(vec![1, 2]));
        assert_eq!(least_views(&views, 0.6), Some(vec![0]));
        assert_eq!(least_views(&views, 0.0), Some(vec![]));
    }

    #[test]
    fn what_no_view_shows_cannot_be_covered() {
        assert_eq!(least_views(&rows(&[&[0]], 2), 1.0), None);
    }
}
