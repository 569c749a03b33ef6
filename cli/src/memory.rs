//! Peak memory, as the kernel reports it.

/// The most memory that this process has had resident, in bytes.
///
/// Linux tells it in `/proc/self/status` (getrusage would need `unsafe`); elsewhere there is none.
pub fn peak_bytes() -> Option<u64> {
    parse(&std::fs::read_to_string("/proc/self/status").ok()?)
}

/// Finds `VmHWM:   1234 kB`.
fn parse(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn the_high_water_mark_is_read_in_bytes() {
        let status = "Name:\troundel\nVmPeak:\t  99 kB\nVmHWM:\t    1234 kB\nVmRSS:\t 7 kB\n";
        assert_eq!(parse(status), Some(1234 * 1024));
    }

    #[test]
    fn a_status_that_does_not_tell_is_no_figure() {
        for status in ["", "VmHWM:\n", "VmHWM: many kB\n", "VmHWM: 12 MB\n"] {
            assert_eq!(parse(status), None, "{status:?}");
        }
    }
}
