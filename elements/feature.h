/* Physics: what an element can be asked for, a type offers and a scene needs; their words in
 * files. */
#ifndef BEAMWORK_FEATURE_H
#define BEAMWORK_FEATURE_H

#include <stdio.h>
#include <string.h>

/* The one table: FEATURE_* (in the order of its bits), name without a comma, summary. */
#define FEATURE_TABLE(ROW)                                                                         \
    ROW(WARPING, "warping", "warping amplitude as a coordinate, bimoment")                         \
    ROW(SHEAR, "shear", "transverse (and warping) shear flexibility")                              \
    ROW(ECCENTRIC, "eccentric shear centre", "shear centre off the centroid")                      \
    ROW(TRAPEZE, "trapeze", "torsion-elongation coupling Ip/A phi'^2/2")                           \
    ROW(WAGNER_MOMENTS, "wagner moments", "int y(y^2+z^2), int z(y^2+z^2)")                        \
    ROW(WAGNER_TORQUE, "wagner torque", "torque cubic in the twist rate")                          \
    ROW(ENGESSER, "engesser", "shear in stability: 1/2 (v'^2 + w'^2) of the fibre")                \
    ROW(HARINGX, "haringx", "shear in stability: rotation of the section (Simo-Reissner)")         \
    ROW(GEOMETRIC, "geometric", "stiffness of the prestressed undeformed state")                   \
    ROW(LARGE, "large rotations", "large displacements and rotations of the structure")            \
    ROW(MASS, "mass", "inertia")                                                                   \
    ROW(ROTARY_INERTIA, "rotary inertia", "rotary and warping inertia in it")                      \
    ROW(CURVATURE, "initial curvature", "initial curvature and strain")

#define FEATURE_NUMBER(feature, name, summary) FEATURE_NUMBER_##feature,
enum { FEATURE_TABLE(FEATURE_NUMBER) FEATURES };
#undef FEATURE_NUMBER

#define FEATURE_BIT(feature, name, summary) FEATURE_##feature = 1 << FEATURE_NUMBER_##feature,
enum element_feature { FEATURE_TABLE(FEATURE_BIT) FEATURE_END = 1 << FEATURES };
#undef FEATURE_BIT

/* Name of one bit, for results and rules, and what it is, in one line; "unknown" for what is none. */
#define FEATURE_TEXT(feature, name, summary)                                                       \
    if (bit == FEATURE_##feature)                                                                  \
        return wanted_summary ? summary : name;
static inline const char *feature_text(unsigned bit, int wanted_summary)
{
    FEATURE_TABLE(FEATURE_TEXT)
    return "unknown";
}
#undef FEATURE_TEXT

static inline const char *feature_name(unsigned bit)
{
    return feature_text(bit, 0);
}

static inline const char *feature_summary(unsigned bit)
{
    return feature_text(bit, 1);
}

/* The bit of a name; 0: there is none. */
static inline unsigned feature_named(const char *name)
{
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if (strcmp(feature_name(bit), name) == 0)
            return bit;
    return 0;
}

/* The names of all bits set into words[size], separated by commas; returns their characters. */
static inline int feature_words(unsigned features, char *words, int size)
{
    int used = 0;
    if (size > 0)
        words[0] = '\0';
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if ((features & bit) && used < size)
            used += snprintf(words + used, (size_t)(size - used), "%s%s", used > 0 ? ", " : "",
                             feature_name(bit));
    return used;
}

#endif
