//! The server's own name.

use std::net::IpAddr;

/// The name of the server in requests.
pub(crate) struct Host {
    pub(crate) port: u16,
    /// That it listens on.
    pub(crate) own: IpAddr,
    /// Other machines can reach it, by addresses that it does not know itself.
    pub(crate) is_open: bool,
}

impl Host {
    /// Whether `name` is this machine's: a loopback name or, where others may ask, any address, since only names can
    /// be made to lead elsewhere.
    pub(crate) fn is(&self, name: &str) -> bool {
        let Some((host, port)) = name.rsplit_once(':') else {
            return false;
        };
        if port != self.port.to_string() {
            return false;
        }
        let bare = host.strip_prefix('[').and_then(|h| h.strip_suffix(']'));
        let address = bare.map_or_else(
            || host.parse().ok().map(IpAddr::V4),
            |bare| bare.parse().ok().map(IpAddr::V6),
        );
        match address {
            Some(address) => {
                self.is_open || address == self.own || matches!(host, "127.0.0.1" | "[::1]")
            }
            None => host.eq_ignore_ascii_case("localhost"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_this_machine_are_its_own() {
        let host = Host {
            port: 8000,
            own: IpAddr::from([127, 0, 0, 1]),
            is_open: false,
        };
        for good in [
            "127.0.0.1:8000",
            "localhost:8000",
            "LOCALHOST:8000",
            "[::1]:8000",
        ] {
            assert!(host.is(good), "{good}");
        }
        for bad in [
            "",
            "127.0.0.1",
            "127.0.0.1:80",
            "evil.example:8000",
            "localhost.evil.example:8000",
            "192.168.0.7:8000",
            "127.0.0.1.evil.example:8000",
            "evil@127.0.0.1:8000",
            "127.0.0.2:8000",
            "::1:8000",
            "127.0.0.1:08000",
        ] {
            assert!(!host.is(bad), "{bad}");
        }
        let open = Host {
            is_open: true,
            ..host
        };
        assert!(open.is("192.168.0.7:8000") && open.is("[fe80::1]:8000"));
        assert!(!open.is("evil.example:8000"));
    }
}
