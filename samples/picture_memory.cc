// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT

// A program's memory is jemalloc's, which reads this (jemalloc(3), "TUNING"). Stages take buffers
// of megabytes one after the other, and would pay more for pages than for what they put there:
// - pages are of 2 MB where the kernel has them: a picture touches a few, not thousands;
// - what is freed is kept, also beyond 8 MB, and is every thread's to take;
// - up to 1 MB of it a thread keeps by itself, so that none waits for another.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf =
    "thp:always,dirty_decay_ms:-1,muzzy_decay_ms:-1,oversize_threshold:0,narenas:1,"
    "lg_tcache_max:20";
}
