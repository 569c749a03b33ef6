//! Strips and fans of triangles, as PLY and glTF have them (glTF 2.0, section 3.7.2.1).

/// The triangles of a strip: every second one is turned, so that all run alike. Those that name a vertex
/// twice only turn the strip around a corner, and are left out.
pub(super) fn strip(vertices: &[i64], mut add: impl FnMut([i64; 3])) {
    for (at, window) in vertices.windows(3).enumerate() {
        let &[a, b, c] = window else { continue };
        if a == b || b == c || c == a {
            continue;
        }
        add(if at % 2 == 0 { [a, b, c] } else { [b, a, c] });
    }
}

/// The triangles of a fan about its first vertex.
pub(super) fn fan(vertices: &[i64], mut add: impl FnMut([i64; 3])) {
    let Some((&first, rest)) = vertices.split_first() else {
        return;
    };
    for pair in rest.windows(2) {
        add([pair[0], pair[1], first]);
    }
}
