//! The referee of `first_contact`: an independent search with 256 binary places.
//!
//! It shares neither formulas nor algorithm with the library:
//!
//! | | library | here |
//! |---|---|---|
//! | arithmetic | doubles | whole numbers of 320 bits ([`fixed`], [`elementary`]), checked against astro-float ([`astro`]) |
//! | flight | divided differences, Taylor series near the start | the textbook's amplitudes ([`textbook`]) |
//! | bounds | energy radius, second and third derivative | Grönwall, fourth derivative, Bernstein hull ([`cell`]) |
//! | search | steps forward as far as is safe | cells cut until each is decided ([`search`], [`exact`]) |
//!
//! What is asked: [`starts`] (random), [`grazing`] (aimed), [`beats`] (long), [`hovering`] (close), [`extremes`] (legal and
//! absurd), [`known`] (what once was wrong), [`long`] (very many). What is required of an answer: [`referee`].

#[cfg(test)]
mod astro;
#[cfg(test)]
mod beats;
#[cfg(test)]
mod case;
#[cfg(test)]
mod cell;
#[cfg(test)]
mod elementary;
#[cfg(test)]
mod exact;
#[cfg(test)]
mod extremes;
#[cfg(test)]
mod fixed;
#[cfg(test)]
mod grazing;
#[cfg(test)]
mod hovering;
#[cfg(test)]
mod known;
#[cfg(test)]
mod long;
#[cfg(test)]
mod march;
#[cfg(test)]
mod random;
#[cfg(test)]
mod referee;
#[cfg(test)]
mod search;
#[cfg(test)]
mod sensitivity;
#[cfg(test)]
mod starts;
#[cfg(test)]
mod tally;
#[cfg(test)]
mod textbook;
