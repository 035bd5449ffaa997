/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: brief */
/* Text without a translation, as in the locale C, and data text, which is never translated. */
#include "test.h"

#include "base/language.h"

TEST(untranslated_text_is_unchanged)
{
    for (int data = 0; data < 2; data++) {
        ceduo_language_set_data(data);
        assert_string_equal(_("no such text"), "no such text");
        assert_string_equal(_(""), "");
        assert_string_equal(ngettext("%d rock", "%d rocks", 1), "%d rock");
        assert_string_equal(ngettext("%d rock", "%d rocks", 0), "%d rocks");
        assert_string_equal(P_("head", "no such head"), "no such head");
        assert_string_equal(ceduo_translate_in(N_("no context")), "no context");
    }
    ceduo_language_set_data(false);
}
