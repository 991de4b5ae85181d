//! The papers that the modules cite.

use crate::modules::Module;

/// A paper: how modules name it, and what it is.
struct Paper {
    /// `Heitz 2018`; where there are several ways, the shortest ends of them.
    cited: &'static [&'static str],
    /// Authors, year, title and where it appeared.
    reference: &'static str,
}

macro_rules! papers {
    ($([$($cited:literal),+] $reference:literal,)*) => {
        &[$(Paper { cited: &[$($cited),+], reference: $reference },)*]
    };
}

/// All of them, by first author.
const PAPERS: &[Paper] = papers![
    ["Abramowitz and Stegun 1964"] "Abramowitz and Stegun 1964. Handbook of Mathematical Functions.",
    ["Belcour 2018"] "Belcour 2018. Efficient Rendering of Layered Materials using an Atomic Decomposition with Statistical Operators. ACM Transactions on Graphics 37(4).",
    ["Bitterli and d'Eon 2022"] "Bitterli and d'Eon 2022. A Position-Free Path Integral for Homogeneous Slabs and Multiple Scattering on Smith Microfacets. Computer Graphics Forum 41(4).",
    ["Burley 2012"] "Burley 2012. Physically Based Shading at Disney. SIGGRAPH course.",
    ["Burley 2015"] "Burley 2015. Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering. SIGGRAPH course.",
    ["Estevez and Kulla 2017"] "Conty Estevez and Kulla 2017. Production Friendly Microfacet Sheen BRDF. SIGGRAPH course.",
    ["Cook and Torrance 1982"] "Cook and Torrance 1982. A Reflectance Model for Computer Graphics. ACM Transactions on Graphics 1(1).",
    ["Cui et al. 2023", "Yan and Wang 2023"] "Cui, Pan, Yang, Zhang, Yan and Wang 2023. Multiple-bounce Smith Microfacet BRDFs using the Invariance Principle. SIGGRAPH Asia.",
    ["Duff et al. 2017"] "Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin 2017. Building an Orthonormal Basis, Revisited. Journal of Computer Graphics Techniques 6(1).",
    ["Duntley 1942"] "Duntley 1942. The Optical Properties of Diffusing Materials. Journal of the Optical Society of America 32(2).",
    ["Dupuy et al. 2016"] "Dupuy, Heitz and d'Eon 2016. Additional Progress Towards the Unification of Microfacet and Microflake Theories. Eurographics Symposium on Rendering.",
    ["Dupuy and Jakob 2018"] "Dupuy and Jakob 2018. An Adaptive Parameterization for Efficient Material Acquisition and Rendering. ACM Transactions on Graphics 37(6).",
    ["Dupuy and Benyoub 2023"] "Dupuy and Benyoub 2023. Sampling Visible GGX Normals with Spherical Caps. Computer Graphics Forum 42(8).",
    ["Egan and Hilgeman 1973"] "Egan, Hilgeman and Reichman 1973. Determination of Absorption and Scattering Coefficients for Nonhomogeneous Media. Applied Optics 12(8).",
    ["d'Eon and Irving 2011"] "d'Eon and Irving 2011. A Quantized-Diffusion Model for Rendering Translucent Materials. ACM Transactions on Graphics 30(4).",
    ["Giles 2010"] "Giles 2010. Approximating the erfinv Function. GPU Computing Gems.",
    ["Hasan and Zhao 2018"] "Guo, Hasan and Zhao 2018. Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs. ACM Transactions on Graphics 37(6).",
    ["Hapke 1981"] "Hapke 1981. Bidirectional Reflectance Spectroscopy: 1. Theory. Journal of Geophysical Research 86(B4).",
    ["Heitz 2014"] "Heitz 2014. Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs. Journal of Computer Graphics Techniques 3(2).",
    ["Heitz and d'Eon 2014"] "Heitz and d'Eon 2014. Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals. Computer Graphics Forum 33(4).",
    ["Heitz 2016", "Heitz et al. 2016", "d'Eon and Dachsbacher 2016"] "Heitz, Hanika, d'Eon and Dachsbacher 2016. Multiple-Scattering Microfacet BSDFs with the Smith Model. ACM Transactions on Graphics 35(4).",
    ["Heitz 2018"] "Heitz 2018. Sampling the GGX Distribution of Visible Normals. Journal of Computer Graphics Techniques 7(4).",
    ["Henyey and Greenstein 1941"] "Henyey and Greenstein 1941. Diffuse Radiation in the Galaxy. Astrophysical Journal 93.",
    ["Hoffman 2019"] "Hoffman 2019. Fresnel Equations Considered Harmful. Workshop on Material Appearance Modeling.",
    ["Jakob 2014"] "Jakob 2014. An Improved Visible Normal Sampling Routine for the Beckmann Distribution. Technical report, ETH Zurich.",
    ["Kulla and Conty 2017"] "Kulla and Conty 2017. Revisiting Physically Based Shading at Imageworks. SIGGRAPH course.",
    ["Hasan and Edmondson 2021"] "Kutz, Hasan and Edmondson 2021. Novel Aspects of the Adobe Standard Material. Technical report, Adobe.",
    ["Jakob and Humphreys 2023"] "Pharr, Jakob and Humphreys 2023. Physically Based Rendering, fourth edition.",
    ["Kutz and Hill 2025"] "Portsmouth, Kutz and Hill 2025. EON: A Practical Energy-Preserving Rough Diffuse BRDF. Journal of Computer Graphics Techniques 14(1).",
    ["Schlick 1994"] "Schlick 1994. An Inexpensive BRDF Model for Physically-based Rendering. Computer Graphics Forum 13(3).",
    ["Shepherd and Laframboise 1981"] "Shepherd and Laframboise 1981. Chebyshev Approximation of (1 + 2x) exp(x^2) erfc x in 0 <= x < inf. Mathematics of Computation 36(153).",
    ["Lea and Flood 2014"] "Steele, Lea and Flood 2014. Fast Splittable Pseudorandom Number Generators. OOPSLA.",
    ["Tokuyoshi 2021"] "Tokuyoshi 2021. Unbiased VNDF Sampling for Backfacing Shading Normals. SIGGRAPH talks.",
    ["Tokuyoshi and Eto 2023"] "Tokuyoshi and Eto 2023. Bounded VNDF Sampling for Smith-GGX Reflections. SIGGRAPH Asia technical communications.",
    ["Tokuyoshi and Eto 2024"] "Tokuyoshi and Eto 2024. Bounded VNDF Sampling for the Smith-GGX BRDF. Proceedings of the ACM on Computer Graphics and Interactive Techniques 7(1).",
    ["Trowbridge and Reitz 1975"] "Trowbridge and Reitz 1975. Average Irregularity Representation of a Rough Surface for Ray Reflection. Journal of the Optical Society of America 65(5).",
    ["Turquin 2019"] "Turquin 2019. Practical Multiple Scattering Compensation for Microfacet Models. Technical report, Industrial Light & Magic.",
    ["Veach and Guibas 1995"] "Veach and Guibas 1995. Optimally Combining Sampling Techniques for Monte Carlo Rendering. SIGGRAPH.",
    ["Walsh 1926"] "Walsh 1926. The Reflection Factor of a Polished Glass Surface for Diffused Light.",
    ["Walter et al. 2007"] "Walter, Marschner, Li and Torrance 2007. Microfacet Models for Refraction through Rough Surfaces. Eurographics Symposium on Rendering.",
    ["Wang et al. 2022", "Holzschuch and Yan 2022"] "Wang, Jin, Fan, Yang, Holzschuch and Yan 2022. Position-Free Multiple-Bounce Computations for Smith Microfacet BSDFs. ACM Transactions on Graphics 41(4).",
];

/// The references of all that the modules cite, by first author.
pub(crate) fn references(modules: &[Module<'_>]) -> Vec<&'static str> {
    let comments: Vec<String> = modules.iter().map(|m| comments(m.text)).collect();
    let papers = PAPERS.iter().filter(|paper| {
        let mut names = paper.cited.iter();
        names.any(|name| comments.iter().any(|c| cites(c, name)))
    });
    papers.map(|p| p.reference).collect()
}

/// All comments of a text on one line, so that a citation is not parted.
fn comments(text: &str) -> String {
    let lines = text.lines().filter_map(|line| line.split_once("//"));
    let words = lines.map(|(_, comment)| comment.trim_start_matches('/').trim());
    words.collect::<Vec<_>>().join(" ")
}

/// Whether a text names a paper, and not one whose authors only end with the same ones.
fn cites(text: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let before = &text[..at];
        // `Heitz 2018` is not in `Dupuy and Heitz 2018`.
        let single = !name.contains(" and ");
        let other = before.ends_with(char::is_alphanumeric);
        !(other || single && before.ends_with("and "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modules::MODULES;

    /// Years that follow a name, with what stands before them.
    fn citations(text: &str) -> Vec<&str> {
        let year = |at: usize| {
            let word = text.get(at..at + 4)?;
            let digits = word.bytes().all(|b| b.is_ascii_digit());
            let plain = !text[at + 4..].starts_with(|c: char| c.is_ascii_alphanumeric());
            (digits && plain && (word.starts_with("19") || word.starts_with("20"))).then_some(())?;
            let before = text[..at].strip_suffix(' ')?;
            let start = before.char_indices().rev().nth(40).map_or(0, |(i, _)| i);
            let last = before
                .trim_end_matches(" et al.")
                .rsplit([' ', '('])
                .next()?;
            let name = last.trim_start_matches("d'");
            let named = name.starts_with(|c: char| c.is_uppercase()) && name.len() > 2;
            named.then(|| &text[start..at + 4])
        };
        let starts = text.char_indices().map(|(at, _)| at);
        starts.filter_map(year).collect()
    }

    #[test]
    fn citations_are_found() {
        let text = comments(
            "// As Heitz et\n// al. 2016 (Jakob 2014), in 2020.\n/// See d'Eon and Irving 2011. 1999x\n",
        );
        let found = citations(&text);
        let ends: Vec<&str> = found.iter().map(|f| &f[f.len() - 9..]).collect();
        assert_eq!(ends, [" al. 2016", "akob 2014", "ving 2011"]);
        assert!(cites(&text, "Heitz et al. 2016") && cites(&text, "Jakob 2014"));
        assert!(!cites("Guo and Jakob 2014", "Jakob 2014"));
        assert!(!cites("McJakob 2014", "Jakob 2014"));
    }

    #[test]
    fn every_citation_has_its_reference() {
        let mut findings = Vec::new();
        for module in MODULES {
            for citation in citations(&comments(module.text)) {
                let mut known = PAPERS.iter().flat_map(|p| p.cited);
                if !known.any(|name| citation.ends_with(name)) {
                    findings.push(format!("{}: {citation}", module.path));
                }
            }
        }
        assert!(findings.is_empty(), "no paper for\n{}", findings.join("\n"));
    }
}
