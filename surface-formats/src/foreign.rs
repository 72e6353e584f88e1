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
    (b"Gwyddion Simple Field", "Gwyddion gsf"),
    (b"Gwyddion XYZ Field", "Gwyddion gxyzf"),
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
    (b"[DataSet]\r\n", "Nanosurf ezd"),
    (b":NANONIS_VERSION:", "Nanonis sxm"),
    (b"OLYMPUSRAWFORMAT", "Olympus oir"),
    (b"II*\0", "TIFF (Olympus lext, Park Systems, JPK)"),
    (b"MM\0*", "TIFF (Olympus lext, Park Systems, JPK)"),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "OLE compound file (xls, mnt)"),
    (b"\x1f\x8b", "gzip archive"),
    (b"\x89PNG\r\n\x1a\n", "PNG picture"),
    (b"\xff\xd8\xff", "JPEG picture"),
];

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
    BEGINNINGS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name)
}

/// Name of the format of a zip archive with these parts, `None` where it is not known.
pub(crate) fn format_of_archive<'a>(
    mut parts: impl Iterator<Item = &'a str> + Clone,
) -> Option<&'static str> {
    let has = |end: &str| parts.clone().any(|part| part.ends_with(end));
    if has("index.xml") && parts.clone().any(|part| part.starts_with("LAYER_")) {
        Some("Sensofar plux")
    } else if has("[Content_Types].xml") {
        Some("Excel workbook xlsx (Mitutoyo)")
    } else if parts.any(|part| part.ends_with(".npy")) {
        Some("NumPy archive npz")
    } else {
        None
    }
}
