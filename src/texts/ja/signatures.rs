//! Why signatures cannot be checked, in Japanese.

use crate::pki::UnverifiableSignature;

pub fn unverifiable(reason: &UnverifiableSignature) -> String {
    use UnverifiableSignature as U;
    match reason {
        U::AlgorithmNotSupported(algorithm) => format!("署名アルゴリズム{algorithm}は、サポートされていません"),
        U::AlgorithmForgeable(algorithm) => format!("{algorithm}による署名は、偽造できます"),
        U::KeyLength(bits) => format!("署名者のRSA鍵が{bits}ビットです。短すぎるか、長すぎます"),
        U::KeyExponent => "署名者のRSA鍵の指数が不正です".to_owned(),
        U::CurveNotSupported => "署名者の鍵の楕円曲線は、サポートされていません".to_owned(),
        U::NotWithCurve { algorithm, curve } => {
            format!("{algorithm}と楕円曲線{curve}の組み合わせは、サポートされていません")
        }
        U::TooManyIssuers => "発行者と同じ名前のCAが多すぎるため、すべてを検査できません".to_owned(),
    }
}
