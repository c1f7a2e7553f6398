macro_rules! countries {
    ($($code:ident,)*) => {
        /// A country that the subject of a certificate may name, by its ISO 3166-1 alpha-2 code.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Country {
            $(
                #[doc = concat!("ISO 3166-1 alpha-2: `", stringify!($code), "`.")]
                $code,
            )*
        }

        impl Country {
            /// In the order of their codes.
            pub const ALL: &[Self] = &[$(Self::$code),*];

            /// ISO 3166-1 alpha-2, upper case.
            pub const fn code(self) -> &'static str {
                match self { $(Self::$code => stringify!($code)),* }
            }
        }
    };
}

impl Country {
    /// `None`: no country has this code. Lower case is not accepted.
    pub fn from_code(code: &str) -> Option<Self> {
        Self::ALL.binary_search_by(|country| country.code().cmp(code)).ok().map(|i| Self::ALL[i])
    }
}

countries! {
    AD, AE, AF, AG, AI, AL, AM, AO, AQ, AR, AS, AT, AU, AW, AX, AZ, BA, BB, BD, BE,
    BF, BG, BH, BI, BJ, BL, BM, BN, BO, BQ, BR, BS, BT, BV, BW, BY, BZ, CA, CC, CD,
    CF, CG, CH, CI, CK, CL, CM, CN, CO, CR, CU, CV, CW, CX, CY, CZ, DE, DJ, DK, DM,
    DO, DZ, EC, EE, EG, EH, ER, ES, ET, FI, FJ, FK, FM, FO, FR, GA, GB, GD, GE, GF,
    GG, GH, GI, GL, GM, GN, GP, GQ, GR, GS, GT, GU, GW, GY, HK, HM, HN, HR, HT, HU,
    ID, IE, IL, IM, IN, IO, IQ, IR, IS, IT, JE, JM, JO, JP, KE, KG, KH, KI, KM, KN,
    KP, KR, KW, KY, KZ, LA, LB, LC, LI, LK, LR, LS, LT, LU, LV, LY, MA, MC, MD, ME,
    MF, MG, MH, MK, ML, MM, MN, MO, MP, MQ, MR, MS, MT, MU, MV, MW, MX, MY, MZ, NA,
    NC, NE, NF, NG, NI, NL, NO, NP, NR, NU, NZ, OM, PA, PE, PF, PG, PH, PK, PL, PM,
    PN, PR, PS, PT, PW, PY, QA, RE, RO, RS, RU, RW, SA, SB, SC, SD, SE, SG, SH, SI,
    SJ, SK, SL, SM, SN, SO, SR, SS, ST, SV, SX, SY, SZ, TC, TD, TF, TG, TH, TJ, TK,
    TL, TM, TN, TO, TR, TT, TV, TW, TZ, UA, UG, UM, US, UY, UZ, VA, VC, VE, VG, VI,
    VN, VU, WF, WS, YE, YT, ZA, ZM, ZW,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_country_is_found_by_its_code() {
        assert_eq!(Country::ALL.len(), 249);
        for country in Country::ALL {
            assert_eq!(Country::from_code(country.code()), Some(*country));
        }
        assert_eq!(Country::from_code("XX"), None);
    }
}
