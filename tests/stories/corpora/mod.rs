//! Readers and rules against many inputs: seeds of the fuzzer, generated values, and test suites of certificates.

mod fuzz_seeds;
mod pkits;
mod properties;
mod trust_corpus;
