//! Damaged files of measured surfaces: no reader panics or takes more memory than the file is worth.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::path::{Path, PathBuf};

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use surface_formats::{Surface, read_bytes, write_npy};

thread_local! {
    // By thread: the tests of this file and the harness run side by side.
    static HELD: Cell<isize> = const { Cell::new(0) };
    static MOST: Cell<isize> = const { Cell::new(0) };
}

/// Adds to the bytes that the thread holds.
fn hold(bytes: isize) {
    HELD.set(HELD.get() + bytes);
    MOST.set(MOST.get().max(HELD.get()));
}

struct Weighing;

#[expect(unsafe_code, reason = "there is no safe way to write a global allocator")]
// SAFETY: every call is handed to the system allocator as it is. Weighing allocates nothing: the counters are
// initialised at compile time and need no destructor.
unsafe impl GlobalAlloc for Weighing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        hold(layout.size().cast_signed());
        // SAFETY: the caller keeps the contract of `alloc`, which is that of the system allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        hold(new_size.cast_signed() - layout.size().cast_signed());
        // SAFETY: as in `alloc`.
        unsafe { System.realloc(pointer, layout, new_size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        hold(-layout.size().cast_signed());
        // SAFETY: as in `alloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Weighing = Weighing;

/// Largest memory of a read beyond its result: buffers of the decompressors, and for each byte of the file the largest
/// content of a byte of text or deflated data.
const BUFFERS: usize = 1 << 20;
const PER_BYTE: usize = 256;

/// The result of `work` and the most bytes that it held at a time.
fn weighed<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = HELD.get();
    MOST.set(before);
    let result = work();
    (result, (MOST.get() - before).unsigned_abs())
}

/// The folder with the small files (`tests/data/surfaces/README.md`).
fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/surfaces").join(name)
}

/// Files tried for each reader: 20000 with `MUTATIONS=20000 cargo test --release --test mutated_files`.
fn mutations() -> usize {
    std::env::var("MUTATIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(2000)
}

/// Up to four changes: bytes and words overwritten, pieces cut out, doubled, or the end cut off.
fn mutate(bytes: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    let mut below = |count: usize| (random.next_u64() % count.max(1) as u64) as usize;
    const WORDS: [&[u8]; 11] = [
        &[0; 4],
        &[0xff; 4],
        &[0xff, 0xff, 0xff, 0x7f],
        &[0, 0, 0, 0x80],
        // NaN and infinity of both lengths
        &[0, 0, 0xc0, 0x7f],
        &[0, 0, 0x80, 0x7f],
        &[0, 0, 0, 0, 0, 0, 0xf8, 0x7f],
        &[0, 0, 0, 0, 0, 0, 0xf0, 0x7f],
        // counts that fill the largest grid
        &[0, 0x20, 0, 0],
        b"8192",
        b" NaN ",
    ];
    for _ in 0..=below(4) {
        // half of the changes go where headers are
        let reach = if below(2) == 0 { bytes.len().min(600) } else { bytes.len() };
        let (at, length) = (below(reach), 1 + below(16));
        let end = (at + length).min(bytes.len());
        match below(7) {
            0 => bytes.truncate(below(bytes.len())),
            1 => drop(bytes.drain(at.min(end)..end)),
            2 => {
                let piece = bytes[at.min(end)..end].to_vec();
                bytes.splice(at.min(end)..at.min(end), piece);
            }
            3 => {
                let word = WORDS[below(WORDS.len())];
                bytes.iter_mut().skip(at).zip(word).for_each(|(byte, new)| *byte = *new);
            }
            4 => {
                let digits = b"0123456789-+.eE*=:,;\n \tNaB<>/#";
                let digit = digits[below(digits.len())];
                bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = digit);
            }
            5 => {
                let new = below(256) as u8;
                bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = new);
            }
            _ => {
                let bit = below(8);
                bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << bit);
            }
        }
    }
}

/// Reads `mutations()` damaged versions of `original`; those that can be read must be sound.
fn survives(original: &[u8], seed: u64, wrap: impl Fn(Vec<u8>) -> Vec<u8>) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut refused, count) = (0, mutations());
    for _ in 0..count {
        let mut bytes = original.to_vec();
        mutate(&mut bytes, &mut random);
        let file = wrap(bytes);
        let (result, most) = weighed(|| read_bytes(&file, "mutated"));
        assert!(most < BUFFERS + PER_BYTE * file.len(), "{most} bytes for a file of {}", file.len());
        match result {
            Ok(surface) => {
                assert_eq!(surface.heights.len(), surface.nx * surface.ny);
                assert!(surface.heights.iter().all(|z| !z.is_infinite()));
                assert!(surface.spacing.is_none_or(|s| s.iter().all(|d| d.is_finite() && *d > 0.0)));
            }
            Err(error) => {
                assert!(error.to_string().contains("mutated"), "{error}");
                refused += 1;
            }
        }
    }
    assert!(refused > count / 20, "only {refused} of {count} mutations were noticed");
}

fn survives_file(name: &str, seed: u64) {
    survives(&std::fs::read(data(name)).unwrap(), seed, |bytes| bytes);
}

#[test]
fn mutated_sur_files_do_not_panic() {
    survives_file("cut.sur", 1);
}

#[test]
fn mutated_compressed_sur_files_do_not_panic() {
    survives_file("compressed.sur", 2);
}

#[test]
fn mutated_ascii_sdf_files_do_not_panic() {
    survives_file("ascii.sdf", 3);
    let text = std::fs::read_to_string(data("ascii.sdf")).unwrap();
    survives(text.replace(" 0.", ", 0.").replace("Compression = 0\n", "").as_bytes(), 23, |bytes| bytes);
}

#[test]
fn mutated_binary_sdf_files_do_not_panic() {
    survives_file("binary.sdf", 4);
}

#[test]
fn mutated_al3d_files_do_not_panic() {
    survives_file("cut.al3d", 5);
}

#[test]
fn mutated_plu_files_do_not_panic() {
    survives_file("cut.plu", 6);
}

#[test]
fn mutated_text_files_do_not_panic() {
    survives_file("cut.txt", 7);
    let rounded: String = (0..12)
        .map(|k| format!("{:.1},{:.1},{k}\n", 0.16 * f64::from(k % 4), 0.16 * f64::from(k / 4)))
        .collect();
    let texts = [
        format!("unit: nm\nWeg (um),H\u{f6}he [um],z1 (nm)\n{rounded}"),
        "# x-pixels = 3\n# x-length = 3\n# x-unit = um\n1 2 3\n4 5 6\n\n7 8 9\n1 2 3\n".to_owned(),
        "0 0.0 0.5 1.0\n0.0 1 2\u{a0}100 3\n0.5 4 5 6\n1.0 7 8 9\n".to_owned(),
        "10.0\n9\n1\n2\n3\n4\n5\n6\n7\n8\n9\n".to_owned(),
    ];
    for (seed, text) in (31..).zip(texts) {
        survives(text.as_bytes(), seed, |bytes| bytes);
    }
}

/// Lines of x, y and height of 4 x 3 points with `separator` between them.
fn columns(separator: &str) -> String {
    (0..12).map(|k| format!("{}.5{separator}{}.5{separator}{}.25\n", k % 4, k / 4, k * k)).collect()
}

#[test]
fn mutated_columns_do_not_panic() {
    survives(format!("x (um),y (um),z (um)\n{}", columns(",")).as_bytes(), 31, |bytes| bytes);
    survives(format!("# x[um] y[um] z[nm]\n{}", columns(" ")).as_bytes(), 32, |bytes| bytes);
    survives(columns("\t").replace('.', ",").as_bytes(), 33, |bytes| bytes);
    let profile: String = (0..12).map(|k| format!("{k}.5;{}.25\n", k % 3)).collect();
    survives(format!("Distance (mm);Height (um)\n{profile}").as_bytes(), 34, |bytes| bytes);
    let edges = ",0.0,0.5,1.0\n0.0,1,2,3\n0.5,4,BAD,6\n1.0,7,8,9\n";
    survives(format!("# unit: um\n{edges}").as_bytes(), 35, |bytes| bytes);
}

#[test]
fn mutated_exports_do_not_panic() {
    let rows = "1\t2\t3\t4\n5\tBad\t7\t8\n9\t10\t11\t12\n";
    let wyko = format!(
        "Wyko ASCII Data File Format 0\t1\t1\nX Size\t3\nY Size\t4\nPixel_size\t7\t4\t0.002\nWavelength\t7\t4\t600\nMult\t7\t4\t1\nRAW_DATA\t3\t48\t\n{rows}"
    );
    survives(wyko.as_bytes(), 41, |bytes| bytes);
    let pixels: String = (0..12).map(|k| format!("{} {} {k}.5\n", k % 4, k / 4)).collect();
    let zygo =
        format!("Zygo XYZ Data File - Format 1\n{}0 1 1 0 1 1 5e-7 0\n#\n{pixels}#\n", "0\n".repeat(6));
    survives(zygo.as_bytes(), 42, |bytes| bytes);
    let prf = "1 2\nSG 0 PRF\nCX I 4 MM 2.5e-4 D\nCZ M 4 UM 1e-1 L\nEOR\nEOR\n-2\n2\n-2\n2\nEOR\n";
    survives(prf.as_bytes(), 43, |bytes| bytes);
    let smd = "ISO 5436-2 - 2000\nname\nPRF 1 p\nCX I 4 mm 1 D 5e-4\nCZ A 4 um 1 D\n\x03\nDATE 1\n\x03\n-2\n2\n-2\n2\n\x03\n1\n\x03\n";
    survives(smd.as_bytes(), 44, |bytes| bytes);
    let keyence = "XY Calibration,500.0,nm\nHorizontal,4\nVertical,3\nUnit,um\n\nHeight\n1.0,2.0,3.0,4.0\n5.0,6.0,7.0,8.0\n9.0,10.0,11.0,12.0\n";
    survives(keyence.as_bytes(), 44, |bytes| bytes);
    let nova = "NX = 4\nNY = 3\nScale X = 0.5\nScale Y = 0.25\nScale Data = 2\nDataScaleNeeded = Yes\nUnit X = um\nUnit Data = nm\n1\t2\t3\t4\n5\t6\t7\t8\n9\t10\t11\t12\n";
    survives(nova.as_bytes(), 45, |bytes| bytes);
}

#[test]
fn mutated_npy_files_do_not_panic() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npy");
    let heights: Vec<f64> = (0..35).map(|k| 1e-7 * f64::from(k).sin()).collect();
    write_npy(&path, &Surface::new(7, 5, heights)).unwrap();
    survives(&std::fs::read(&path).unwrap(), 8, |bytes| bytes);
}

#[test]
fn mutated_x3p_files_do_not_panic() {
    survives_file("cut.x3p", 9);
}

/// Damage inside the archive, which its checksum would else hide from the reader.
#[test]
fn x3p_files_with_mutated_descriptions_do_not_panic() {
    use std::io::{Read, Write};
    let mut archive = zip::ZipArchive::new(std::fs::File::open(data("cut.x3p")).unwrap()).unwrap();
    let mut part = |name: &str| {
        let mut bytes = Vec::new();
        archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    };
    let (xml, points, mask) = (part("main.xml"), part("bindata/data.bin"), part("bindata/valid.bin"));
    survives(&xml, 10, |xml| {
        let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        let parts = [("main.xml", &xml), ("bindata/data.bin", &points), ("bindata/valid.bin", &mask)];
        let stored =
            zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        for (name, content) in parts {
            writer.start_file(name, stored).unwrap();
            writer.write_all(content).unwrap();
        }
        writer.finish().unwrap().into_inner()
    });
}

#[test]
fn a_lie_about_the_size_costs_no_memory() {
    let patched = |name: &str, patches: &[(usize, &[u8])]| {
        let mut bytes = std::fs::read(data(name)).unwrap();
        for (at, patch) in patches {
            bytes[*at..at + patch.len()].copy_from_slice(patch);
        }
        bytes
    };
    // 8192 x 8192 is the largest size accepted
    let (many, product) = (8192_u32.to_le_bytes(), (1_u32 << 26).to_le_bytes());
    let sdf = String::from_utf8(std::fs::read(data("ascii.sdf")).unwrap()).unwrap();
    let sdf =
        sdf.replace("NumPoints = 7", "NumPoints = 8192").replace("NumProfiles = 4", "NumProfiles = 8192");
    let npy =
        b"\x93NUMPY\x01\x00\x40\x00{'descr': '<f8', 'fortran_order': True, 'shape': (8192, 8192)}      ";
    let text = "x-pixels = 8192\ny-pixels = 8192\n1 2\n";
    let files: [Vec<u8>; 7] = [
        patched("cut.sur", &[(108, &many), (112, &many), (116, &product)]),
        patched("compressed.sur", &[(108, &many), (112, &many), (116, &product)]),
        patched("binary.sdf", &[(42, &[0, 0x20, 0, 0x20])]),
        patched("cut.plu", &[(500, &many), (504, &many)]),
        sdf.into_bytes(),
        npy.to_vec(),
        text.as_bytes().to_vec(),
    ];
    for (k, file) in files.iter().enumerate() {
        let (result, most) = weighed(|| read_bytes(file, "mutated"));
        let error = result.map(|surface: Surface| surface.nx).unwrap_err().to_string();
        assert!(
            error.contains("8192 x 8192") || error.contains("(8192, 8192)") || error.contains("bytes"),
            "{k}: {error}"
        );
        assert!(most < BUFFERS, "{k}: {most} bytes");
    }
}

/// An x3p archive of `bytes` zeros; its description is that of a small one after `change`.
fn bomb(bytes: usize, change: impl Fn(&str) -> String) -> Vec<u8> {
    use std::io::{Read, Write};
    let mut archive = zip::ZipArchive::new(std::fs::File::open(data("cut.x3p")).unwrap()).unwrap();
    let mut xml = String::new();
    archive.by_name("main.xml").unwrap().read_to_string(&mut xml).unwrap();
    let xml = change(&xml);
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let zeros = vec![0; bytes];
    for (name, content) in [("main.xml", xml.as_bytes()), ("bindata/data.bin", &zeros)] {
        writer.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// 64 MiB of zeros deflate to 64 kB: what comes out is held against what the description says before more is
/// taken.
#[test]
fn a_bomb_is_cut_short() {
    let file = bomb(1 << 26, str::to_owned);
    let (result, most) = weighed(|| read_bytes(&file, "bomb"));
    assert!(result.unwrap_err().to_string().contains("more than the expected"));
    assert!(most < BUFFERS, "{most} bytes");
}

/// Zeros as the description says shrink to a thousandth, as no measurement does.
#[test]
fn a_bomb_that_tells_its_size_is_refused() {
    let large = |xml: &str| {
        let (before, rest) = xml.split_once("<SizeX>").unwrap();
        let (_, after) = rest.split_once("<SizeZ>").unwrap();
        format!("{before}<SizeX>4096</SizeX><SizeY>4096</SizeY><SizeZ>{after}")
    };
    let file = bomb(8 << 24, large);
    let (result, most) = weighed(|| read_bytes(&file, "bomb"));
    let error = result.unwrap_err().to_string();
    assert!(error.contains("134217728 bytes of heights, more than 200 times as many"), "{error}");
    assert!(most < BUFFERS, "{most} bytes");
}
