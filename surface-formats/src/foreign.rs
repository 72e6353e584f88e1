//! Formats that have no reader here, by their first bytes.

/// First bytes and name of each format.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"VK3_", "Keyence vk3"),
    (b"VK4_", "Keyence vk4"),
    (b"VK6", "Keyence vk6"),
    (b"VK7", "Keyence vk7"),
    (b"KPK0", "Keyence zon"),
    (b"KPK1", "Keyence zon"),
    (b"\x88\x1b\x03\x6f", "Zygo MetroPro dat"),
    (b"\x88\x1b\x03\x70", "Zygo MetroPro dat"),
    (b"\x88\x1b\x03\x71", "Zygo MetroPro dat"),
    (b"VCA DATA", "Bruker Dektak opdx"),
    (b"Zeta-Instruments", "Zeta zmg"),
    (b"fileType", "Molecular Imaging mi"),
    (b"GWYP", "Gwyddion gwy"),
    (b"GWYO", "Gwyddion gwy"),
    (b"\x89HDF\r\n\x1a\n", "HDF5 (Zygo datx, netCDF 4)"),
    (b"CDF\x01", "netCDF"),
    (b"CDF\x02", "netCDF"),
    (b"MATLAB 5.0 MAT-file", "MATLAB mat"),
    (b"MATLAB 7.3 MAT-file", "MATLAB mat"),
    (b"\x01\xb0\x93\xff", "NT-MDT mdt"),
    (b"FRTM_GLIDERV", "FRT MicroProf frt"),
    (b"OmniSurf3D", "OmniSurf3D os3d"),
    (b"Binary TrueMap Data File", "TrueMap tmd"),
    (b"WSxM file copyright", "WSxM stp"),
    (b"fileformat = bcr", "Image Metrology bcr"),
    (b"f\0i\0l\0e\0f\0o\0r\0m\0a\0t\0", "Image Metrology bcr"),
    (b"\xff\xfef\0i\0l\0e\0f\0o\0r\0m\0a\0t\0", "Image Metrology bcr"),
    (b"\xfe\xff\0f\0i\0l\0e\0f\0o\0r\0m\0a\0t", "Image Metrology bcr"),
    (b"[DataSet]\r\n", "Nanosurf ezd, nid"),
    (b"OLYMPUSRAWFORMAT", "Olympus oir"),
    (b"II*\0", "TIFF (Olympus lext, Park Systems, JPK)"),
    (b"MM\0*", "TIFF (Olympus lext, Park Systems, JPK)"),
];

/// First bytes and names of content that no program reads heights from.
const OTHERS: &[(&[u8], &str)] = &[
    (b"Gwyddion Simple Field", "a file of Gwyddion gsf; Gwyddion saves it as text"),
    (b"Gwyddion XYZ Field", "a file of Gwyddion gxyzf; Gwyddion saves it as text"),
    (b":NANONIS_VERSION:", "a file of Nanonis sxm; Gwyddion saves it as text"),
    (b"\x1f\x8b", "a gzip archive; unpack it"),
    (b"\x89PNG\r\n\x1a\n", "a PNG picture holds no heights"),
    (b"\xff\xd8\xff", "a JPEG picture holds no heights"),
    (b"%PDF", "a PDF document holds no heights"),
    (OLE, "an Excel workbook xls; save the sheet of heights as text"),
];

/// First bytes of a compound file.
const OLE: &[u8] = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";
/// Name of the part of a compound file that holds a workbook.
const WORKBOOK: &[u8] = b"W\0o\0r\0k\0b\0o\0o\0k\0";
/// Version and further bytes at the begin of files of Igor that hold waves.
const IGOR: [&[u8]; 2] = [b"\x05\0", b"\x02\0"];

/// First bytes of the header of Nanoscope, which its text exports have too.
const NANOSCOPE: &[u8] = b"\\*File list";
/// End of the header of a binary Nanoscope file.
const CONTROL_Z: u8 = 0x1a;

/// Name of the format of a file with these `bytes`, `None` where it has a reader or is not known.
pub(crate) fn format_of(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(NANOSCOPE) && bytes.contains(&CONTROL_Z) {
        return Some("Nanoscope spm");
    }
    // two bytes of its own come first
    if bytes.get(2..).is_some_and(|rest| rest.starts_with(b"Directory")) {
        return Some("Wyko opd");
    }
    if bytes.starts_with(OLE) && !contains(bytes, WORKBOOK) {
        return Some("Digital Surf mnt");
    }
    if is_igor(bytes) {
        return Some("Igor ibw");
    }
    if bytes.starts_with(b"\x02\0\0\0\x01\0\0\0") {
        return Some("Nanofocus nms");
    }
    BEGINNINGS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name)
}

/// Content that is known not to be read anywhere as heights, with the remedy.
pub(crate) fn other_content(bytes: &[u8]) -> Option<&'static str> {
    OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, what)| *what)
}

/// Whether `part` stands anywhere in `bytes`.
fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

/// Whether the sum of the 16 bit integers of a header of Igor is zero, as its checksum makes it.
fn is_igor(bytes: &[u8]) -> bool {
    // headers of version 5 and version 2, with that of the wave
    let length = match bytes.get(..2) {
        Some(begin) if begin == IGOR[0] => 64 + 320,
        Some(begin) if begin == IGOR[1] => 16 + 110,
        _ => return false,
    };
    let header = bytes.get(..length).map(|header| header.chunks_exact(2));
    header.is_some_and(|pairs| {
        pairs.fold(0u16, |sum, pair| sum.wrapping_add(u16::from_le_bytes([pair[0], pair[1]]))) == 0
    })
}

/// Name of the format of a zip archive with these parts, `None` where it is not known.
pub(crate) fn format_of_archive<'a>(
    mut parts: impl Iterator<Item = &'a str> + Clone,
) -> Option<&'static str> {
    let has = |end: &str| parts.clone().any(|part| part.ends_with(end));
    if has("index.xml") && parts.clone().any(|part| part.starts_with("LAYER_")) {
        Some("Sensofar plux")
    } else if parts.any(|part| part.ends_with(".npy")) {
        Some("NumPy archive npz")
    } else {
        None
    }
}
