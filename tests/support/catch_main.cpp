#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

/// As in Catch2 3, a filter that matches no test is an error.
int main(int argc, char* argv[]) {
    Catch::Session session;
    session.configData().warnings = Catch::WarnAbout::NoTests;
    return session.run(argc, argv);
}
