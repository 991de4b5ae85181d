//! What instructions of SPIR-V compute, as expressions of C++. Integers are unsigned; `$a`, `$b` and `$c` are operands,
//! of vectors one component after the other.

/// By their numbers (SPIR-V 1.3, 3.32.11 to 3.32.15).
const OPERATIONS: [(u32, &str); 56] = [
    (83, "$a"),
    (109, "uint32_t(int64_t($a))"),
    (110, "uint32_t(int32_t($a))"),
    (111, "float(int32_t($a))"),
    (112, "float($a)"),
    (126, "0u - $a"),
    (127, "-$a"),
    (128, "$a + $b"),
    (129, "$a + $b"),
    (130, "$a - $b"),
    (131, "$a - $b"),
    (132, "$a * $b"),
    (133, "$a * $b"),
    (134, "$a / $b"),
    (135, "uint32_t(int32_t($a) / int32_t($b))"),
    (136, "$a / $b"),
    (137, "$a % $b"),
    (138, "uint32_t(int32_t($a) % int32_t($b))"),
    (141, "$a - $b * floorf($a / $b)"),
    (142, "$a * $b"),
    (156, "std::isnan($a)"),
    (157, "std::isinf($a)"),
    (164, "$a == $b"),
    (165, "$a != $b"),
    (166, "$a || $b"),
    (167, "$a && $b"),
    (168, "!$a"),
    (169, "$a ? $b : $c"),
    (170, "$a == $b"),
    (171, "$a != $b"),
    (172, "$a > $b"),
    (173, "int32_t($a) > int32_t($b)"),
    (174, "$a >= $b"),
    (175, "int32_t($a) >= int32_t($b)"),
    (176, "$a < $b"),
    (177, "int32_t($a) < int32_t($b)"),
    (178, "$a <= $b"),
    (179, "int32_t($a) <= int32_t($b)"),
    (180, "$a == $b"),
    (181, "!($a < $b || $a > $b)"),
    (182, "$a < $b || $a > $b"),
    (183, "$a != $b"),
    (184, "$a < $b"),
    (185, "!($a >= $b)"),
    (186, "$a > $b"),
    (187, "!($a <= $b)"),
    (188, "$a <= $b"),
    (189, "!($a > $b)"),
    (190, "$a >= $b"),
    (191, "!($a < $b)"),
    (194, "$a >> $b"),
    (195, "uint32_t(int32_t($a) >> $b)"),
    (196, "$a << $b"),
    (197, "$a | $b"),
    (198, "$a ^ $b"),
    (199, "$a & $b"),
];

/// Instructions of the set `GLSL.std.450` by their numbers.
const FUNCTIONS: [(u32, &str); 26] = [
    (3, "truncf($a)"),
    (4, "fabsf($a)"),
    (8, "floorf($a)"),
    (9, "ceilf($a)"),
    (10, "$a - floorf($a)"),
    (13, "sinf($a)"),
    (14, "cosf($a)"),
    (26, "powf($a, $b)"),
    (27, "expf($a)"),
    (28, "logf($a)"),
    (29, "exp2f($a)"),
    (30, "log2f($a)"),
    (31, "sqrtf($a)"),
    (32, "1.0f / sqrtf($a)"),
    (37, "least($a, $b)"),
    (38, "least($a, $b)"),
    (40, "largest($a, $b)"),
    (41, "largest($a, $b)"),
    (43, "least(largest($a, $b), $c)"),
    (44, "least(largest($a, $b), $c)"),
    (46, "$a * (1.0f - $c) + $b * $c"),
    (50, "fmaf($a, $b, $c)"),
    (79, "fminf($a, $b)"),
    (80, "fmaxf($a, $b)"),
    (81, "fminf(fmaxf($a, $b), $c)"),
    (48, "$b < $a ? 0.0f : 1.0f"),
];

/// What an instruction computes of each component.
pub(super) fn operation(number: u32) -> Option<&'static str> {
    let found = OPERATIONS.iter().find(|(known, _)| *known == number);
    found.map(|(_, expression)| *expression)
}

/// What an instruction of `GLSL.std.450` computes of each component.
pub(super) fn function(number: u32) -> Option<&'static str> {
    let found = FUNCTIONS.iter().find(|(known, _)| *known == number);
    found.map(|(_, expression)| *expression)
}
