// Decimal digits of a number, see json_file.f90: the conversions of the C library take a third of the time of formatted statements
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Least and most significant digits that are tried
enum { LEAST = 15, MOST = 17 };
/// Normal numbers that differ by more units of the last of MOST digits are read as different ones: half a step between numbers is at
/// most 2^-53 of 10^MOST of these units, and rounding adds a half
static const int NEAR = 12;

/// Digits of a number, correctly rounded to a count of them, followed by zeros; returns the exponent of the first digit
static int split(double value, int count, char digits[MOST])
{
    // sign, digits, a decimal point of several bytes in some languages, exponent
    char text[MOST + 24];
    snprintf(text, sizeof text, "%.*e", count - 1, value);
    const char *end = strchr(text, 'e');
    memset(digits, '0', MOST);
    digits[0] = text[0];
    memcpy(digits + 1, end - (count - 1), (size_t)(count - 1));
    return atoi(end + 1);
}

/// Round MOST digits, with a null behind them, to fewer; returns whether they end half way and do not determine the direction
static int is_half_way(int count, const char most[MOST + 1], char digits[MOST], int *exponent)
{
    memset(digits, '0', MOST);
    memcpy(digits, most, (size_t)count);
    if (most[count] == '5' && strspn(most + count + 1, "0") >= (size_t)(MOST - count - 1)) return 1;
    if (most[count] < '5') return 0;
    int k = count - 1;
    for (; k >= 0 && digits[k] == '9'; k--) digits[k] = '0';
    if (k >= 0) {
        digits[k]++;
    } else {
        digits[0] = '1';
        ++*exponent;
    }
    return 0;
}

/// Are so many digits read back as the number?
static int is_same(double value, const char *digits, int count, int exponent)
{
    char text[MOST + 8];
    memcpy(text, digits, (size_t)count);
    // digits are read as a whole number
    int power = exponent - (count - 1), size = abs(power);
    char *end = text + count;
    *end++ = 'e';
    *end++ = power < 0 ? '-' : '+';
    *end++ = (char)('0' + size / 100);
    *end++ = (char)('0' + size / 10 % 10);
    *end++ = (char)('0' + size % 10);
    *end = '\0';
    return strtod(text, NULL) == value;
}

/// Digits of a finite positive number, 15, 16 or 17 of them: the fewest that are read back as the same number
///
/// Writes MOST characters, trailing ones "0", and the exponent of the first digit. Fewer digits are those of MOST, rounded: they
/// are printed again only where these end half way.
void contact_number_digits(double value, char digits[MOST], int *exponent)
{
    char most[MOST + 1] = "";
    int power = split(value, MOST, most);
    int rest = 10 * (most[LEAST] - '0') + most[LEAST + 1] - '0';
    int first = value >= DBL_MIN && rest > NEAR && rest < 100 - NEAR ? LEAST + 1 : LEAST;
    for (int count = first; count < MOST; count++) {
        *exponent = power;
        if (is_half_way(count, most, digits, exponent)) *exponent = split(value, count, digits);
        if (is_same(value, digits, count, *exponent)) return;
    }
    memcpy(digits, most, MOST);
    *exponent = power;
}
