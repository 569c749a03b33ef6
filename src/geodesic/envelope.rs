//! Lists of windows on one half-edge: in order of place, each the nearest where it is, but for small overlaps.

use super::bisector::nearer;
use super::window::Window;

/// Merges two lists into one that keeps the nearer window at each place, the old one of equals.
pub(super) fn merge(old: &[Window], new: &[Window], out: &mut Vec<Window>) {
    out.clear();
    let (mut olds, mut news) = (old.iter().copied(), new.iter().copied());
    let (mut one, mut two) = (olds.next(), news.next());
    while let (Some(first), Some(second)) = (&mut one, &mut two) {
        if first.a < second.a {
            let end = first.b.min(second.a);
            append(out, part(first, first.a, end));
            first.a = end;
        } else if second.a < first.a {
            let end = second.b.min(first.a);
            append(out, part(second, second.a, end));
            second.a = end;
        } else {
            let (from, to) = (first.a, first.b.min(second.b));
            append_nearer(out, first, second, from, to);
            first.a = to;
            second.a = to;
        }
        if first.a >= first.b {
            one = olds.next();
        }
        if second.a >= second.b {
            two = news.next();
        }
    }
    for rest in one.into_iter().chain(olds).chain(two).chain(news) {
        append(out, rest);
    }
}

/// Windows that follow each other may overlap by this share of the narrower one. To cut them at every edge would
/// take more time than to carry the overlap to the next.
const OVERLAP: f64 = 0.5;

fn width(window: &Window) -> f64 {
    window.b - window.a
}

/// Adds a window that follows those of a list. It may start before the last ones end, as lines from different roots
/// cross within a face.
pub(super) fn push(list: &mut Vec<Window>, mut window: Window, spare: &mut Vec<Window>) {
    while let Some(last) = list.last_mut() {
        if window.a >= last.b {
            break;
        }
        let is_in_order = last.a <= window.a && last.b <= window.b;
        if is_in_order && last.b - window.a <= OVERLAP * width(last).min(width(&window)) {
            break;
        }
        if !is_in_order {
            return insert(list, window, spare);
        }
        let found = nearer(last, &window, window.a, last.b);
        if found.changes[1].is_finite() || !found.first && found.changes[0].is_finite() {
            return insert(list, window, spare);
        }
        let middle = match (found.first, found.changes[0].is_finite()) {
            (true, true) => found.changes[0],
            (true, false) => last.b,
            (false, _) => window.a,
        };
        last.b = middle;
        window.a = middle;
        if last.b > last.a {
            break;
        }
        list.pop();
    }
    append(list, window);
}

/// Merges a window with those that it overlaps, at the end of a list.
fn insert(list: &mut Vec<Window>, window: Window, spare: &mut Vec<Window>) {
    let kept = list
        .iter()
        .rposition(|w| w.b <= window.a)
        .map_or(0, |i| i + 1);
    merge(&list[kept..], &[window], spare);
    list.truncate(kept);
    spare.iter().for_each(|&w| append(list, w));
}

/// Adds the parts of the nearer window on an interval that both cover.
fn append_nearer(out: &mut Vec<Window>, one: &Window, two: &Window, from: f64, to: f64) {
    let found = nearer(one, two, from, to);
    let mut windows = if found.first { [one, two] } else { [two, one] };
    let mut start = from;
    for change in found.changes {
        let end = change.min(to);
        append(out, part(windows[0], start, end));
        start = end;
        windows.swap(0, 1);
    }
    append(out, part(windows[0], start, to));
}

fn part(window: &Window, a: f64, b: f64) -> Window {
    Window { a, b, ..*window }
}

/// Adds a window that starts where the list ends or later. One that continues the last is joined with it.
fn append(out: &mut Vec<Window>, window: Window) {
    if window.a >= window.b {
        return;
    }
    match out.last_mut() {
        Some(last) if last.b == window.a && last.has_image_of(&window) => last.b = window.b,
        _ => out.push(window),
    }
}
