//! The direction of the sun.

use glam::{DMat4, DVec3};

use super::element::Element;
use crate::error::{ErrorKind, SceneError};

/// Parameters that name a place and a time.
const MOMENT: [&str; 9] = [
    "latitude",
    "longitude",
    "timezone",
    "year",
    "month",
    "day",
    "hour",
    "minute",
    "second",
];

/// Unit vector to the sun in the world.
///
/// * `to_world`: the light's own space to the world's.
pub(super) fn direction(element: &Element, to_world: &DMat4) -> Result<DVec3, SceneError> {
    if let Some(given) = element.vector("sun_direction")? {
        if let Some(name) = MOMENT.iter().find(|n| element.has(n)) {
            let message = format!("\"sun_direction\" and \"{name}\" exclude each other");
            let place = element.place_of(name);
            return Err(SceneError::new(ErrorKind::Parameter, &place, message));
        }
        return given
            .try_normalize()
            .ok_or_else(|| element.error("\"sun_direction\": expected a vector that is not 0"));
    }
    let (zenith, azimuth) = coordinates(&Moment::read(element)?);
    let (sin, cos) = zenith.sin_cos();
    let local = if element.legacy {
        // The 0.6 dialect: y is up and azimuths run from -z to +x.
        DVec3::new(azimuth.sin() * sin, cos, -azimuth.cos() * sin)
    } else {
        // Mitsuba 3: z is up, +x to the south and +y to the west.
        let phi = azimuth - std::f64::consts::PI;
        DVec3::new(phi.cos() * sin, phi.sin() * sin, cos)
    };
    Ok(to_world.transform_vector3(local).normalize())
}

struct Moment {
    latitude_rad: f64,
    longitude_rad: f64,
    /// Days since noon of 1 January 2000, universal time.
    days: f64,
    /// Hours of the day, universal time.
    hours: f64,
}

impl Moment {
    fn read(element: &Element) -> Result<Self, SceneError> {
        let hours = element.number("hour", 15.0)? - element.number("timezone", 9.0)?
            + element.number("minute", 0.0)? / 60.0
            + element.number("second", 0.0)? / 3600.0;
        let year = i64::from(element.integer_within("year", 2010, 1..=9999)?);
        let month = i64::from(element.integer_within("month", 7, 1..=12)?);
        let day = i64::from(element.integer_within("day", 10, 1..=31)?);
        Ok(Self {
            latitude_rad: element.number("latitude", 35.6894)?.to_radians(),
            longitude_rad: element.number("longitude", 139.6917)?.to_radians(),
            #[expect(clippy::cast_precision_loss, reason = "a few million days")]
            days: (julian_day(year, month, day) - 2_451_545) as f64 - 0.5 + hours / 24.0,
            hours,
        })
    }
}

/// Number of the Julian day that begins at noon of a date of the Gregorian calendar.
///
/// Source: Fliegel and Van Flandern 1968.
fn julian_day(year: i64, month: i64, day: i64) -> i64 {
    let late = (month - 14) / 12;
    (1461 * (year + 4800 + late)) / 4 + (367 * (month - 2 - 12 * late)) / 12
        - (3 * ((year + 4900 + late) / 100)) / 4
        + day
        - 32_075
}

/// Zenith angle and azimuth (from the north towards the east), in radians.
///
/// Source: Blanco-Muriel et al. 2001, the PSA algorithm, which both Mitsubas use.
fn coordinates(moment: &Moment) -> (f64, f64) {
    let days = moment.days;
    let omega = 2.1429 - 0.001_039_459_4 * days;
    let anomaly = 6.240_06 + 0.017_201_969_9 * days;
    let ecliptic_longitude = 4.895_063
        + 0.017_202_791_698 * days
        + 0.033_416_07 * anomaly.sin()
        + 0.000_348_94 * (2.0 * anomaly).sin()
        - 0.000_113_4
        - 0.000_020_3 * omega.sin();
    let obliquity = 0.409_092_8 - 6.214e-9 * days + 0.000_039_6 * omega.cos();
    let (sin_longitude, cos_longitude) = ecliptic_longitude.sin_cos();
    let right_ascension = (obliquity.cos() * sin_longitude).atan2(cos_longitude);
    let declination = (obliquity.sin() * sin_longitude).asin();
    let greenwich_hours = 6.697_424_324_2 + 0.065_709_828_3 * days + moment.hours;
    let hour_angle = (greenwich_hours * 15.0).to_radians() + moment.longitude_rad - right_ascension;
    let (sin_latitude, cos_latitude) = moment.latitude_rad.sin_cos();
    let cosine =
        cos_latitude * hour_angle.cos() * declination.cos() + declination.sin() * sin_latitude;
    let zenith = cosine.clamp(-1.0, 1.0).acos();
    let azimuth = (-hour_angle.sin())
        .atan2(declination.tan() * cos_latitude - sin_latitude * hour_angle.cos());
    // Parallax: the earth's mean radius over the astronomical unit.
    const PARALLAX: f64 = 6_371.01 / 149_597_890.0;
    (zenith + PARALLAX * zenith.sin(), azimuth)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tokyo on 10 July 2010, as Mitsuba 3.9.1 reports `sun_direction` for its default place.
    #[test]
    fn the_sun_stands_where_mitsuba_has_it() {
        for (hour, expected) in [
            (9.0, DVec3::new(0.095_695_2, -0.614_786, 0.782_867)),
            (12.0, DVec3::new(0.231_117, 0.054_388_8, 0.971_405)),
            (15.0, DVec3::new(0.051_385_4, 0.691_748, 0.720_308)),
        ] {
            let hours = hour - 9.0;
            let days = (julian_day(2010, 7, 10) - 2_451_545) as f64 - 0.5 + hours / 24.0;
            let (zenith, azimuth) = coordinates(&Moment {
                latitude_rad: 35.6894_f64.to_radians(),
                longitude_rad: 139.6917_f64.to_radians(),
                days,
                hours,
            });
            let phi = azimuth - std::f64::consts::PI;
            let (sin, cos) = zenith.sin_cos();
            let found = DVec3::new(phi.cos() * sin, phi.sin() * sin, cos);
            assert!(found.distance(expected) < 1e-3, "{hour}: {found}");
        }
    }

    #[test]
    fn julian_days_are_the_published_ones() {
        assert_eq!(julian_day(2000, 1, 1), 2_451_545);
        assert_eq!(julian_day(2010, 7, 10), 2_455_388);
    }
}
