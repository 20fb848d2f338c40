//! Everything that fuzzing found worth keeping is read without a fuzzer, too: `fuzz/corpus`, a folder for
//! each reader.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::fs;
use std::hint::black_box;
use std::path::PathBuf;

use adslam_tests::readers::{READERS, Reader};
use adslam_tests::repository;

fn corpus(reader: &str) -> Vec<PathBuf> {
    let folder = repository("fuzz/corpus").join(reader);
    let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// Reads all of a reader's corpus; the name of the file is part of the test's output where one fails.
fn replay(name: &str) {
    let reader = Reader::named(name).unwrap();
    let files = corpus(name);
    assert!(files.len() > 5, "{name} has a corpus of {}", files.len());
    for file in files {
        println!("{}", file.display());
        reader.read(&fs::read(&file).unwrap());
    }
}

macro_rules! readers {
    ($($name:ident),*) => {
        $(#[test] fn $name() { replay(stringify!($name)); })*

        #[test]
        fn every_reader_is_here() {
            let here = [$(stringify!($name)),*];
            assert_eq!(READERS.map(|reader| reader.name), here);
        }
    };
}

readers!(
    scenario, config, sweep, published, log, stl, obj, ply, history
);

#[test]
fn every_folder_has_a_reader_and_the_whole_is_small() {
    let mut bytes = 0;
    for folder in fs::read_dir(repository("fuzz/corpus")).unwrap() {
        let name = folder.unwrap().file_name().into_string().unwrap();
        assert!(Reader::named(&name).is_some(), "fuzz/corpus/{name}");
        let sizes = corpus(&name)
            .into_iter()
            .map(|f| fs::metadata(f).unwrap().len());
        bytes += sizes.sum::<u64>();
    }
    assert!(bytes < 1 << 20, "the corpus has {bytes} bytes");
}

/// The bound on memory is one that is felt.
#[test]
#[should_panic(expected = "bytes of memory, more than")]
fn a_reader_that_takes_too_much_is_noticed() {
    let greedy = Reader::new("greedy", |_| drop(black_box(vec![1_u8; 2 << 20])), 1 << 20);
    greedy.read(b"a byte");
}
