//! The memory of this process: its peak, from the operating system's own account, and what it does not use.

/// The most memory that this process has had resident so far, in bytes; `None` where the operating
/// system does not tell.
pub fn peak_memory() -> Option<u64> {
    #[cfg(unix)]
    {
        let mut usage = std::mem::MaybeUninit::<libc::rusage>::zeroed();
        // SAFETY: the pointer is to a writable `rusage`, and RUSAGE_SELF is a valid request.
        let code = unsafe { libc::getrusage(libc::RUSAGE_SELF, usage.as_mut_ptr()) };
        if code != 0 {
            return None;
        }
        // SAFETY: all bits zero are a valid `rusage` of integers, whatever the call wrote over them.
        let most = u64::try_from(unsafe { usage.assume_init() }.ru_maxrss).ok()?;
        // Apple counts bytes, all others kibibytes.
        let unit = if cfg!(target_vendor = "apple") {
            1
        } else {
            1024
        };
        most.checked_mul(unit)
    }
    #[cfg(not(unix))]
    None
}

/// Gives memory that this process has freed back to the operating system. The allocator of glibc keeps such memory
/// where it lies between blocks in use. With other allocators nothing happens.
pub fn release_free_memory() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        // SAFETY: the allocator takes its own locks, and leaves all blocks in use as they are.
        unsafe { libc::malloc_trim(0) };
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::sync::Mutex;

    /// Only one of these tests has much memory at a time.
    static MUCH: Mutex<()> = Mutex::new(());

    #[test]
    fn the_peak_grows_by_the_memory_that_is_touched_and_never_falls() {
        const MORE: usize = 256 << 20;
        let _much = MUCH.lock().unwrap();
        let before = peak_memory().unwrap();
        let touched = vec![1_u8; before as usize + MORE];
        let during = peak_memory().unwrap();
        assert!(during >= before + MORE as u64, "{before} to {during}");
        assert!(during < 16 * (before + MORE as u64), "bytes, not kibibytes");
        drop(touched);
        assert!(peak_memory().unwrap() >= during);
    }

    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[test]
    fn free_memory_between_blocks_in_use_is_given_back() {
        let _much = MUCH.lock().unwrap();
        let resident = || {
            let status = std::fs::read_to_string("/proc/self/status").unwrap();
            let line = status.lines().find(|line| line.starts_with("VmRSS:"));
            let kibibytes = line.unwrap().split_whitespace().nth(1).unwrap();
            kibibytes.parse::<usize>().unwrap() << 10
        };
        // Small enough for the heap, in which one of eight stays.
        let mut blocks: Vec<Vec<u8>> = (0..8192).map(|_| vec![1; 32 << 10]).collect();
        let mut number = 0;
        blocks.retain(|_| {
            number += 1;
            number % 8 == 0
        });
        let before = resident();
        release_free_memory();
        let after = resident();
        assert!(after + (128 << 20) < before, "{before} to {after}");
        assert!(blocks.iter().flatten().all(|&byte| byte == 1));
    }
}
