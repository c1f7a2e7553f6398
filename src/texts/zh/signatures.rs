//! Why signatures cannot be checked, in Chinese.

use crate::pki::UnverifiableSignature;

pub fn unverifiable(reason: &UnverifiableSignature) -> String {
    use UnverifiableSignature as U;
    match reason {
        U::AlgorithmNotSupported(algorithm) => format!("不支持签名算法 {algorithm}"),
        U::AlgorithmForgeable(algorithm) => format!("使用 {algorithm} 的签名可以被伪造"),
        U::KeyLength(bits) => format!("签名者的 RSA 密钥为 {bits} 位，过短或过长"),
        U::KeyExponent => "签名者的 RSA 密钥的指数无效".to_owned(),
        U::CurveNotSupported => "不支持签名者密钥所用的椭圆曲线".to_owned(),
        U::NotWithCurve { algorithm, curve } => format!("不支持 {algorithm} 与椭圆曲线 {curve} 的组合"),
        U::TooManyIssuers => "与签发者同名的 CA 过多，无法逐一验证".to_owned(),
    }
}
