//! Names that are legal in C: one place that turns what users write into identifiers.

use crate::macros::{MACROS, is_format};
use rustc_hash::FxHashSet;
use std::borrow::Cow;
use std::sync::LazyLock;

/// Keywords of C and C++, and what macros or the base types of any C library make unusable as a member.
const KEYWORDS: &str = "\
    EDOM EILSEQ EOF ERANGE FILE HUGE_VAL I INFINITY NAN NDEBUG NULL alignas alignof and and_eq asm assert auto \
    bitand bitor bool break case catch char char16_t char32_t char8_t class co_await co_return co_yield compl \
    complex concept const const_cast consteval constexpr constinit continue decltype default defined delete do \
    double dynamic_cast else enum errno explicit export extern false far float for fortran friend goto huge i386 if \
    imaginary inline int int16_t int32_t int64_t int8_t interface linux long math_errhandling memcpy memset mips \
    mutable namespace near new noexcept noreturn not not_eq nullptr offsetof operator or or_eq private protected \
    public register reinterpret_cast requires restrict return short signed size_t sizeof static static_assert \
    static_cast stderr stdin stdout struct switch template this thread_local throw true try typedef typeid typename \
    typeof typeof_unqual uint16_t uint32_t uint64_t uint8_t union unix unsigned using virtual void volatile wchar_t \
    while xor xor_eq \
";

/// Functions and types of the C library (and of POSIX): no program can have these names.
const LIBRARY: &str = "\
    DIR abort abs accept access acos acosf acosh acoshf acosl alarm asctime asin asinf asinh asinhf asinl atan atan2 \
    atan2f atan2l atanf atanh atanhf atanl atexit atof atoi atol atoll bcmp bcopy bind brk bsearch bzero cabs calloc \
    carg cbrt cbrtf ccos ceil ceilf ceill cexp chdir chmod cimag clearerr clock clock_t clog close conj connect \
    copysign copysignf cos cosf cosh coshf cosl cpow creal creat csin csqrt ctan ctime difftime div div_t double_t \
    drem dup environ erf erfc erfcf erff execl execv execve exit exp exp10 exp2 exp2f expf expl expm1 expm1f fabs \
    fabsf fabsl fclose fcntl fdim fdimf fdopen feof ferror fflush ffs fgetc fgetpos fgets fileno finite float_t \
    floor floorf floorl fma fmaf fmax fmaxf fmin fminf fmod fmodf fmodl fopen fork fpclassify fpos_t fprintf fputc \
    fputs fread free freopen frexp frexpf fscanf fseek fsetpos fstat ftell fwrite gamma getc getchar getenv getline \
    getopt getpid gets gmtime hypot hypotf ilogb ilogbf imaxabs index intmax_t intptr_t ioctl isalnum isalpha isatty \
    isblank iscntrl isdigit isfinite isgraph isinf islower isnan isnormal isprint ispunct isspace isupper isxdigit \
    j0 j1 jmp_buf jn kill labs ldexp ldexpf ldiv ldiv_t lgamma lgammaf link listen llabs lldiv llrint llround \
    localeconv localtime log log10 log10f log1p log1pf log2 log2f logb logbf logf logl longjmp lrint lrintf lround \
    lroundf lseek main malloc mblen mbstowcs mbtowc memchr memcmp memmove mkdir mktime mmap modf modff nan nanf \
    nearbyint nextafter nextafterf nexttoward nice off_t open pause perror pid_t pipe poll pow pow10 powf powl \
    printf ptrdiff_t putc putchar putenv puts qsort raise rand random read readdir realloc recv remainder remainderf \
    remove remquo rename rewind rindex rint rintf rmdir round roundf roundl sbrk scalb scalbln scalbn scalbnf scanf \
    select send setbuf setjmp setlocale setvbuf shutdown sigaction signal signbit signgam significand sin sincos \
    sinf sinh sinhf sinl sleep snprintf socket sprintf sqrt sqrtf sqrtl srand sscanf ssize_t stat strcat strchr \
    strcmp strcoll strcpy strcspn strdup strerror strftime strlen strncat strncmp strncpy strpbrk strrchr strspn \
    strstr strtod strtof strtok strtol strtoll strtoul strxfrm symlink sync system tan tanf tanh tanhf tanl tgamma \
    tgammaf time time_t times tm tmpfile tmpnam tolower toupper trunc truncate truncf truncl uint uintmax_t \
    uintptr_t ulong umask uname ungetc unlink ushort usleep utime va_arg va_list vfprintf vprintf vsnprintf vsprintf \
    wait wcslen write y0 y1 yn \
";

/// Variables and parameters of the functions that the compiler writes, which would hide a program of that name, and the
/// member of every net.
const VARIABLES: &str = "\
    after bad block box boxes changed cold command complete controller done edge end faults filled fire fired \
    first forced full gate gates go hand happened held holds hot i instance iwork key last later least left marked \
    mode moved n net nets next now number obeyed order output outputs parameters place put ready room scan self \
    set sets statement status stopped substep T take term tokens twork value waiting wanted work writes \
";

/// The C name of a program, given its configured name or its source file's stem.
pub fn program_name(text: &str) -> String {
    let name = legal(text, "p").into_owned();
    let ours = name.starts_with("pcl2_") || name.starts_with("PCL2_") || name.eq_ignore_ascii_case("pcl2");
    if is_taken_at_file_scope(&name) || ours || HEADERS.contains(&name.as_str()) { name + "_" } else { name }
}

/// Headers that the generated C includes: a program's own would hide them.
const HEADERS: [&str; 4] = ["math", "stddef", "stdint", "string"];

/// Keeps a name that [`program_name`] made, and makes anything else legal.
pub(crate) fn settled_program_name(text: &str) -> String {
    match text.strip_suffix('_') {
        Some(stem) if program_name(stem) == text => text.to_owned(),
        Some(_) | None => program_name(text),
    }
}

/// Names that no program can have.
static TAKEN_AT_FILE_SCOPE: LazyLock<FxHashSet<&str>> =
    LazyLock::new(|| LIBRARY.split_whitespace().chain(VARIABLES.split_whitespace()).collect());

fn is_taken_at_file_scope(name: &str) -> bool {
    TAKEN_AT_FILE_SCOPE.contains(name)
}

/// Names that no member can have.
static TAKEN: LazyLock<FxHashSet<&str>> =
    LazyLock::new(|| KEYWORDS.split_whitespace().chain(MACROS.split_whitespace()).collect());

fn is_taken(name: &str) -> bool {
    TAKEN.contains(name) || is_format(name)
}

/// A text as a legal member name. `3` becomes `b3` (`prefix` and the number), `FIC.bk` `FIC_bk`, `ain(0,1,1)` `ain_0_1_1`.
fn legal<'a>(text: &'a str, prefix: &str) -> Cow<'a, str> {
    let plain = text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let named = text.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
    let mut name = if plain && named { Cow::Borrowed(text) } else { Cow::Owned(mapped(text, prefix)) };
    let ours = name.starts_with("pcl2_") || name.starts_with("PCL2_");
    if is_taken(&name) || (plain && name.ends_with('_')) || ours {
        name.to_mut().push('_');
    }
    name
}

fn mapped(text: &str, prefix: &str) -> String {
    let separators = |letter: char| !letter.is_ascii_alphanumeric() && letter != '_';
    let name = text.split(separators).filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_");
    let named = name.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
    if named { name } else { format!("{prefix}{name}") }
}

/// One name space: gives every name once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Namer<'a> {
    used: FxHashSet<Cow<'a, str>>,
}

impl<'a> Namer<'a> {
    /// A name space in which these are taken.
    pub(crate) fn new(taken: &[&'static str]) -> Namer<'a> {
        Namer { used: taken.iter().map(|name| Cow::Borrowed(*name)).collect() }
    }

    /// Takes a name that is legal already.
    pub(crate) fn reserve(&mut self, name: &str) {
        self.used.insert(Cow::Owned(name.to_owned()));
    }

    /// A legal name for this text, numbered if it is taken.
    pub(crate) fn name(&mut self, text: &'a str) -> Cow<'a, str> {
        self.take(legal(text, "b"))
    }

    /// As [`Namer::name`], for a name of ours: only numbered if it is taken.
    pub(crate) fn made(&mut self, text: &str) -> String {
        let name = legal(text, "b").into_owned();
        if self.used.insert(Cow::Owned(name.clone())) { name } else { self.numbered(&name).into_owned() }
    }

    /// As [`Namer::made`], for a name that begins others: none of these stands behind it in a name that is taken. They are
    /// taken with it.
    pub(crate) fn family(&mut self, text: &str, suffixes: &[String]) -> String {
        let wanted = legal(text, "b").into_owned();
        let names = |name: &str| -> Vec<String> { suffixes.iter().map(|suffix| format!("{name}_{suffix}")).collect() };
        let taken =
            |name: &str| self.used.contains(name) || names(name).iter().any(|name| self.used.contains(name.as_str()));
        let mut name = wanted.clone();
        let mut number = 2;
        while taken(&name) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        self.used.extend(names(&name).into_iter().map(Cow::Owned));
        self.used.insert(Cow::Owned(name.clone()));
        name
    }

    fn take(&mut self, wanted: Cow<'a, str>) -> Cow<'a, str> {
        if self.used.insert(wanted.clone()) {
            return wanted;
        }
        let reserved: Cow<'a, str> = Cow::Owned(format!("{wanted}_"));
        if !wanted.ends_with('_') && self.used.insert(reserved.clone()) {
            return reserved;
        }
        self.numbered(&wanted)
    }

    fn numbered(&mut self, wanted: &str) -> Cow<'a, str> {
        let mut number = 2;
        loop {
            let numbered: Cow<'a, str> = Cow::Owned(format!("{wanted}_{number}"));
            if self.used.insert(numbered.clone()) {
                return numbered;
            }
            number += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_map_readably() {
        let mut namer = Namer::new(&["in"]);
        let pairs = [
            ("y1", "y1"),
            ("3", "b3"),
            ("FIC.bk", "FIC_bk"),
            ("ain(0,1,1)", "ain_0_1_1"),
            ("b#2", "b_2"),
            ("int", "int_"),
            ("int_", "int__"),
            ("in", "in_"),
            ("errno", "errno_"),
            ("b3", "b3_"),
            ("N.S0", "N_S0"),
            ("y1", "y1_"),
            ("y1", "y1_2"),
            ("3.sp", "b3_sp"),
            ("", "b"),
        ];
        for (text, name) in pairs {
            assert_eq!(namer.name(text), name, "{text}");
        }
    }

    #[test]
    fn families_keep_apart() {
        let mut namer = Namer::new(&["n_tune"]);
        let suffixes = ["init", "tune"].map(str::to_owned);
        assert_eq!(namer.family("n", &suffixes), "n_2");
        assert_eq!(namer.made("n_2_init"), "n_2_init_2");
        assert_eq!(namer.family("n_2", &suffixes), "n_2_2");
        assert_eq!(namer.family("m", &suffixes), "m");
    }

    #[test]
    fn program_names() {
        let pairs = [
            ("main", "main_"),
            ("math", "math_"),
            ("PCL2", "PCL2_"),
            ("demo", "demo"),
            ("self", "self_"),
            ("y1", "y1_"),
            ("2tanks", "p2tanks"),
            ("a-b", "a_b"),
            ("x_", "x__"),
        ];
        for (text, name) in pairs {
            assert_eq!(program_name(text), name);
            assert_eq!(settled_program_name(name), name);
        }
    }
}
