//! DER, written by hand: a certificate with a flaw is what no library wants to write.

use chrono::{DateTime, Utc};

pub fn tlv(tag: u8, parts: &[&[u8]]) -> Vec<u8> {
    let content = parts.concat();
    let mut der = vec![tag];
    match content.len() {
        length @ 0..=0x7f => der.push(length as u8),
        length @ 0x80..=0xff => der.extend([0x81, length as u8]),
        length @ 0x100..=0xffff => der.extend([0x82, (length >> 8) as u8, length as u8]),
        length => der.extend([0x83, (length >> 16) as u8, (length >> 8) as u8, length as u8]),
    }
    der.extend(content);
    der
}

pub fn seq(parts: &[&[u8]]) -> Vec<u8> {
    tlv(0x30, parts)
}

pub fn set(parts: &[&[u8]]) -> Vec<u8> {
    tlv(0x31, parts)
}

/// The bytes as they are, sign and all.
pub fn int(bytes: &[u8]) -> Vec<u8> {
    tlv(0x02, &[bytes])
}

pub fn boolean(value: bool) -> Vec<u8> {
    vec![0x01, 1, if value { 0xff } else { 0 }]
}

pub fn octets(content: &[u8]) -> Vec<u8> {
    tlv(0x04, &[content])
}

pub fn bits(content: &[u8]) -> Vec<u8> {
    tlv(0x03, &[&[0], content])
}

pub fn oid(text: &str) -> Vec<u8> {
    let arcs: Vec<u32> = text.split('.').map(|arc| arc.parse().unwrap()).collect();
    let mut content = vec![(arcs[0] * 40 + arcs[1]) as u8];
    for arc in &arcs[2..] {
        let mut digits = vec![(arc & 0x7f) as u8];
        let mut rest = arc >> 7;
        while rest > 0 {
            digits.push((rest & 0x7f) as u8 | 0x80);
            rest >>= 7;
        }
        content.extend(digits.iter().rev());
    }
    tlv(0x06, &[&content])
}

/// As RFC 5280 §4.1.2.5 wants it: with two digits of the year until 2049.
pub fn time(time: DateTime<Utc>) -> Vec<u8> {
    if time < DateTime::parse_from_rfc3339("2050-01-01T00:00:00Z").unwrap() {
        tlv(0x17, &[time.format("%y%m%d%H%M%SZ").to_string().as_bytes()])
    } else {
        generalized_time(time)
    }
}

pub fn generalized_time(time: DateTime<Utc>) -> Vec<u8> {
    tlv(0x18, &[time.format("%Y%m%d%H%M%SZ").to_string().as_bytes()])
}
