/* Features: the physics that scenes require, element types support and requests select. Names of
 * the features in files. */
#ifndef BEAMWORK_FEATURE_H
#define BEAMWORK_FEATURE_H

#include <stdio.h>
#include <string.h>

/* Feature bits. feature_row_of has a row for each bit. */
enum element_feature {
    FEATURE_WARPING = 1 << 0,
    FEATURE_SHEAR = 1 << 1,
    FEATURE_ECCENTRIC = 1 << 2,
    FEATURE_TRAPEZE = 1 << 3,
    FEATURE_WAGNER_MOMENTS = 1 << 4,
    FEATURE_WAGNER_TORQUE = 1 << 5,
    FEATURE_ENGESSER = 1 << 6,
    FEATURE_HARINGX = 1 << 7,
    FEATURE_GEOMETRIC = 1 << 8,
    FEATURE_LARGE = 1 << 9,
    FEATURE_MASS = 1 << 10,
    FEATURE_ROTARY_INERTIA = 1 << 11,
    FEATURE_CURVATURE = 1 << 12,
    FEATURE_COUPLED = 1 << 13,
    FEATURE_END = 1 << 14
};

/* Name and summary of a feature bit. */
typedef struct feature_row {
    unsigned bit;        /* element_feature */
    const char *name;    /* name without a comma */
    const char *summary; /* one line */
} feature_row;

/* Returns the row of a feature. The name in the row is "unknown" if `bit` is not a single known
 * bit. */
static inline const feature_row *feature_row_of(unsigned bit)
{
    static const feature_row row[] = {
        {FEATURE_WARPING, "warping", "warping amplitude as a coordinate, bimoment"},
        {FEATURE_SHEAR, "shear", "shear flexibility, transverse and of warping"},
        {FEATURE_ECCENTRIC, "eccentric shear centre", "shear centre off the centroid"},
        {FEATURE_TRAPEZE, "trapeze", "torsion-elongation coupling Ip/A phi'^2/2"},
        {FEATURE_WAGNER_MOMENTS, "wagner moments", "int y(y^2+z^2), int z(y^2+z^2)"},
        {FEATURE_WAGNER_TORQUE, "wagner torque", "torque cubic in the twist rate"},
        {FEATURE_ENGESSER, "engesser", "shear in stability: 1/2 (v'^2 + w'^2) of each fibre"},
        {FEATURE_HARINGX, "haringx", "shear in stability: rotation of the section (Simo-Reissner)"},
        {FEATURE_GEOMETRIC, "geometric", "stiffness of the prestressed undeformed state"},
        {FEATURE_LARGE, "large rotations", "large displacements and rotations of the structure"},
        {FEATURE_MASS, "mass", "inertia"},
        {FEATURE_ROTARY_INERTIA, "rotary inertia", "rotary and warping inertia of sections"},
        {FEATURE_CURVATURE, "initial curvature", "initial curvature and strain"},
        {FEATURE_COUPLED, "coupled section",
         "stiffness and mass matrices of a section with any entries"},
        {0, "unknown", "unknown"}};
    const feature_row *one = row;
    while (one->bit != 0 && one->bit != bit)
        one++;
    return one;
}

/* Returns the name of a feature in files and results. */
static inline const char *feature_name(unsigned bit)
{
    return feature_row_of(bit)->name;
}

/* Returns the one-line summary of a feature. */
static inline const char *feature_summary(unsigned bit)
{
    return feature_row_of(bit)->summary;
}

/* Returns the bit of the feature with this name, or 0 if the name is unknown. */
static inline unsigned feature_named(const char *name)
{
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if (strcmp(feature_name(bit), name) == 0)
            return bit;
    return 0;
}

/* Writes the names of all features of `features` to words[size], separated by commas. Returns the
 * number of characters, or at least `size` if the text is truncated. */
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
