//! Thinning of records.

/// Returns evenly spaced indices below `count`, including the first and the last. Their number is at most `most`, but
/// at least two.
pub(super) fn evenly(count: usize, most: usize) -> Vec<usize> {
    let kept = most.max(2).min(count);
    if kept == count {
        return (0..count).collect();
    }
    (0..kept).map(|k| k * (count - 1) / (kept - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::evenly;

    #[test]
    fn the_ends_are_kept_and_gaps_are_even() {
        assert!(evenly(0, 5).is_empty());
        assert_eq!(evenly(1, 5), [0]);
        assert_eq!(evenly(4, 9), [0, 1, 2, 3]);
        assert_eq!(evenly(9, 5), [0, 2, 4, 6, 8]);
        assert_eq!(evenly(1000, 0), [0, 999]);
        let some = evenly(1001, 87);
        assert_eq!((some.len(), some[0], some[86]), (87, 0, 1000));
        let gaps = some.windows(2).map(|w| w[1] - w[0]);
        assert!(gaps.clone().all(|gap| (11..=12).contains(&gap)));
    }
}
