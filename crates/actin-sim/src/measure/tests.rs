//! Scratch.
use super::*;
use crate::Monomers;
#[test]
fn slope() {
    for n in [64usize, 160] { for seed in 0..3 {
        let s = Specimen::ellipsoids(73.94, Monomers{seed, lateral_bonds:n, longitudinal_bonds:n, ..Monomers::default()});
        let c = twist(&s, &[-10.,-5.,-2.,-1.,-0.5,-0.2,0.2,0.5,1.,2.,5.,10.]).unwrap();
        for i in 6..12 { let (a,b)=(&c.points[11-i],&c.points[i]);
            println!("{n} {seed} {} slope {:.5} over {:.5} under {:.5} B3 {:.2} {:.2}", b.turn_deg,(b.relative_length_change-a.relative_length_change)/2./b.curvature_rad_per_nm, b.relative_length_change/b.curvature_rad_per_nm, a.relative_length_change/a.curvature_rad_per_nm,b.rigidity_pn_nm2,a.rigidity_pn_nm2);}
    }}
}
