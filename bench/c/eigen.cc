// Products with Eigen, row-major as ours, on its own fixed-size matrices.
#include <Eigen/Core>

template <int N> static void product(const double *a, const double *b, double *m)
{
    using Matrix = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
    Eigen::Map<Matrix>(m).noalias() = Eigen::Map<const Matrix>(a) * Eigen::Map<const Matrix>(b);
}

extern "C" void eigen_product4(const double *a, const double *b, double *m)
{
    product<4>(a, b, m);
}

extern "C" void eigen_product8(const double *a, const double *b, double *m)
{
    product<8>(a, b, m);
}
