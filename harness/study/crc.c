#include "harness/study/study_impl.h"

#include <zlib.h>

#ifdef __x86_64__
#include <immintrin.h>

enum { BLOCK = 16 };

/* Folds blocks of 16 bytes by carry-less multiplication (V. Gopal et al., Fast CRC Computation for
 * Generic Polynomials Using PCLMULQDQ Instruction, Intel, 2009), and reduces the last block. size:
 * a multiple of BLOCK. */
__attribute__((target("pclmul,sse4.1"))) static uint32_t
fold(uint32_t state, const unsigned char *data, size_t size)
{
    const __m128i by = _mm_set_epi64x(0x0ccaa009e, 0x1751997d0), /* x^96, x^160, reflected */
        last = _mm_set_epi64x(0, 0x163cd6124),                   /* x^64 */
        barrett = _mm_set_epi64x(0x1f7011641, 0x1db710641),      /* quotient, polynomial */
        words = _mm_setr_epi32(~0, 0, ~0, 0);
    __m128i x =
        _mm_xor_si128(_mm_loadu_si128((const __m128i *)data), _mm_cvtsi32_si128((int)state));
    for (size_t at = BLOCK; at < size; at += BLOCK) {
        const __m128i next = _mm_loadu_si128((const __m128i *)(data + at)),
                      low = _mm_clmulepi64_si128(x, by, 0x00),
                      high = _mm_clmulepi64_si128(x, by, 0x11);
        x = _mm_xor_si128(next, _mm_xor_si128(low, high));
    }
    x = _mm_xor_si128(_mm_srli_si128(x, 8), _mm_clmulepi64_si128(x, by, 0x10));
    x = _mm_xor_si128(_mm_srli_si128(x, 4),
                      _mm_clmulepi64_si128(_mm_and_si128(x, words), last, 0x00));
    __m128i q = _mm_clmulepi64_si128(_mm_and_si128(x, words), barrett, 0x10);
    q = _mm_clmulepi64_si128(_mm_and_si128(q, words), barrett, 0x00);
    return (uint32_t)_mm_extract_epi32(_mm_xor_si128(x, q), 1);
}

uint32_t crc_add(uint32_t sum, const unsigned char *data, size_t size)
{
    const size_t whole = size - size % BLOCK;
    if (whole > 0 && __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("sse4.1")) {
        sum = ~fold(~sum, data, whole);
        data += whole;
        size -= whole;
    }
    return (uint32_t)crc32_z(sum, data, size);
}
#else
uint32_t crc_add(uint32_t sum, const unsigned char *data, size_t size)
{
    return (uint32_t)crc32_z(sum, data, size);
}
#endif
