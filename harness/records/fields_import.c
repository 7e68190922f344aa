/* Records of what other programs found: each value with its place in the file it was read from. */
#include "harness/records/fields_keys.h"

static void get_file(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->file);
}

static void import_get_model(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->model);
}

static void get_convention(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->imported->convention);
}

static const schema_field fields_of_import[] = {
    {"elements", "1", FIELD_INT, "elements, as the file says", AT(imported_row, elements)},
    {"file", "", FIELD_TEXT, "that it was read from", .get = get_file},
    {"line", "1", FIELD_INT, "of the file", AT(imported_row, line)},
    {"model", "", FIELD_TEXT, "beam, or another one", .get = import_get_model},
    {"convention", "", FIELD_TEXT, "of moments", .get = get_convention},
    {"file_unit", "", FIELD_TEXT, "of the value in the file", AT(imported_row, unit)},
    {"factor", "1", FIELD_DOUBLE, "that the file's value was multiplied by",
     AT(imported_row, factor)},
    {"unknowns", "1", FIELD_INT, "unknown coordinates; 0: not said", AT(imported_row, unknowns)},
    {"seconds", "s", FIELD_DOUBLE, "of the solution, measured elsewhere",
     AT(imported_row, seconds)},
    {"x_unit", "", FIELD_TEXT, "of the abscissa of a curve", OF(QUANTITY, scene_quantity, x.unit)},
    {"x", "x_unit", FIELD_DOUBLE, "abscissa of a curve", AT(imported_row, x)},
    {"value", OWN_UNIT, FIELD_DOUBLE, "in the unit of the quantity", AT(imported_row, value)},
    {"uncertainty", OWN_UNIT, FIELD_DOUBLE, "of the value", AT(imported_row, uncertainty)},
    {0}};
const record_type record_import = {
    "import",
    "imports",
    "a value that another program found, and where it was read",
    {keys_of_point, keys_of_series, names_of_quantity, fields_of_import}};
